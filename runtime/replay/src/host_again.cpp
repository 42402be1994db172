// SPDX-License-Identifier: Apache-2.0
#include "host_again.hpp"

#include <array>

#include "rave/control/requests.hpp"
#include "rave/control/world_request.hpp"
#include "rave/host/host_part.hpp"

namespace rave::runtime {
// A recording of one host has the sums that this host added to the run hash. To repeat them bit by
// bit, the run is split in the same way: one engine has the robots of the host, another one all
// others, and an authority resolves both. Only the first is compared.
namespace {

constexpr std::uint32_t kOwn = 0;
constexpr std::uint32_t kRest = 1;

}  // namespace

Result<std::unique_ptr<HostAgain>> HostAgain::create(const config::ExpandedScenario& scenario,
                                                     const std::string& host,
                                                     plugin::Catalogue& catalogue,
                                                     const BuildOptions& options) {
  RAVE_TRY_ASSIGN(const HostPart part, find_host_part(scenario, host));
  std::vector<std::uint32_t> host_of(scenario.robots.size(), kRest);
  for (const RobotId robot : part.robots) host_of[robot.value()] = kOwn;
  std::vector<RobotId> rest;
  for (std::uint32_t r = 0; r < host_of.size(); ++r) {
    if (host_of[r] == kRest) rest.emplace_back(r);
  }
  const auto spec_of = [&](const std::vector<RobotId>& robots) -> Result<sim::EngineSpec> {
    BuildOptions how = options;
    how.local = robots;
    RAVE_TRY_ASSIGN(BuiltScenario built, build(scenario, catalogue, how));
    built.spec.live_clock = nullptr;
    return std::move(built.spec);
  };
  std::unique_ptr<HostAgain> again(new HostAgain());
  again->own_report_.host = kOwn;
  again->rest_report_.host = kRest;
  // A spec owns parts of drivers and cannot be copied, so the scenario is built once for each of
  // the three.
  RAVE_TRY_ASSIGN(sim::EngineSpec own, spec_of(part.robots));
  own.on_step_done = [raw = again.get()] {
    if (raw->look) raw->look();
  };
  RAVE_TRY_ASSIGN(again->own_, sim::Engine::create(std::move(own)));
  if (!rest.empty()) {
    RAVE_TRY_ASSIGN(sim::EngineSpec others, spec_of(rest));
    RAVE_TRY_ASSIGN(again->rest_, sim::Engine::create(std::move(others)));
  }
  RAVE_TRY_ASSIGN(sim::EngineSpec world, spec_of(part.robots));
  RAVE_TRY_ASSIGN(again->authority_,
                  sim::WorldAuthority::create(std::move(world), std::move(host_of)));
  return again;
}

Result<std::string> HostAgain::ask(const request::Request& request) {
  auto input = input_of(authority_->spec(), request);
  // All other requests were made to the host itself.
  if (!input) return serve_request(*own_, request);
  RAVE_TRY(authority_->ask(*std::move(input)));
  return std::string();
}

Status HostAgain::propose() {
  RAVE_TRY(own_->propose(own_report_));
  return rest_ ? rest_->propose(rest_report_) : Status();
}

Status HostAgain::step() {
  if (!std::exchange(begun_, true)) RAVE_TRY(propose());
  const std::array<const sim::HostReport*, 2> reports = {&own_report_, &rest_report_};
  RAVE_TRY(authority_->step(std::span(reports).first(rest_ ? 2 : 1), world_));
  // The next step is proposed right away, as in a host: its report contains the hardware samples of
  // that step.
  RAVE_TRY(own_->apply(world_));
  if (rest_) RAVE_TRY(rest_->apply(world_));
  return propose();
}

std::vector<sim::Event> HostAgain::beside() const { return obstacle_events(world_); }

}  // namespace rave::runtime
