// SPDX-License-Identifier: Apache-2.0
#include "commands/bench.hpp"

#include <chrono>

#include "console.hpp"
#include "error_text.hpp"
#include "places.hpp"

namespace rave::cli {
namespace {

constexpr double kUsual_s = 5;

swarm::RunEnd usual(swarm::RunEnd end) {
  if (!end.steps && !end.seconds) end.seconds = kUsual_s;
  return end;
}

}  // namespace

Result<int> bench_swarm(const BenchSwarmCommand& command) {
  const auto began = std::chrono::steady_clock::now();
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue({}));
  Console console(true);
  RAVE_TRY_ASSIGN(const auto run, swarm::run_swarm(command.workload, usual(command.end), *catalogue,
                                                   &console, began));
  if (!command.write.empty()) {
    const double duration_s = static_cast<double>(run.steps) * swarm::kStep_s;
    RAVE_TRY(swarm::write_scenario(command.workload, duration_s, command.write));
  }
  put(stdout, swarm::swarm_json(run) + "\n");
  return kGood;
}

Result<int> bench_compare(const swarm::CompareOptions& command) {
  swarm::CompareOptions options = command;
  options.end = usual(options.end);
  const auto comparison = swarm::compare(options);
  if (!comparison) {
    const int code = complain(comparison.error());
    return comparison.error().code == ErrorCode::kState ? kNotGood : code;
  }
  put(stdout, swarm::comparison_json(*comparison) + "\n");
  put(stderr, swarm::comparison_text(*comparison) + "\n");
  return kGood;
}

}  // namespace rave::cli
