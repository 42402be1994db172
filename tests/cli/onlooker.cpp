// SPDX-License-Identifier: Apache-2.0
#include "onlooker.hpp"

namespace rave::cli_test {

Result<std::unique_ptr<bus::Bus>> join_as_onlooker(const bus::RunId& run,
                                                   const std::vector<std::string>& apart,
                                                   bool beside) {
  bus::BusConfig config;
  config.beside = beside;
  config.participant = "listener";
  config.run = run;
  for (std::size_t i = 0; i + 1 < apart.size(); ++i) {
    if (apart[i] == "--bus-tag") config.tag = apart[i + 1];
    if (apart[i] == "--domain")
      config.domain = static_cast<std::uint32_t>(std::stoul(apart[i + 1]));
  }
  return bus::Bus::open(config);
}

Result<std::unique_ptr<StepListener>> StepListener::open(const bus::RunId& run,
                                                         const std::vector<std::string>& apart) {
  RAVE_TRY_ASSIGN(auto bus, join_as_onlooker(run, apart));
  RAVE_TRY_ASSIGN(auto worlds, bus::Reader<bus::WorldStep>::create(*bus));
  return std::unique_ptr<StepListener>(new StepListener(std::move(bus), std::move(worlds)));
}

void StepListener::listen() {
  const auto now = std::chrono::steady_clock::now();
  worlds_.take([&](const bus::WorldStep& world) {
    if (world.step > step()) seen_.push_back({now, world.step});
  });
}

std::uint64_t StepListener::step_at(std::chrono::steady_clock::time_point when) const {
  std::uint64_t step = 0;
  for (const Seen& seen : seen_) {
    if (seen.when <= when) step = seen.step;
  }
  return step;
}

}  // namespace rave::cli_test
