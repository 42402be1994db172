// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::runtime {

/// Repeats a run of several hosts in lock-step in this process: one engine for the host whose
/// recording is checked, one for all others, and the authority between them. Used by one thread.
class HostAgain {
 public:
  /// `catalogue` must outlive it. Errors: those of build() and Engine::create(), kNotFound (the
  /// scenario has no such host).
  [[nodiscard]] static Result<std::unique_ptr<HostAgain>> create(
      const config::ExpandedScenario& scenario, const std::string& host,
      plugin::Catalogue& catalogue, const BuildOptions& options);

  /// Makes a request that counts from the next step on, as recorded by the host. Returns a
  /// description for people.
  Result<std::string> ask(const request::Request& request);
  /// Errors: those of Engine::propose(), Engine::apply() and WorldAuthority::step().
  Status step();
  /// The events of the last step that are missing in the engine of the host.
  [[nodiscard]] std::vector<sim::Event> beside() const;
  [[nodiscard]] sim::Engine& engine() noexcept { return *own_; }

  /// Called after each step, like EngineSpec::on_step_done of the host.
  std::function<void()> look;

 private:
  HostAgain() = default;
  Status propose();

  std::unique_ptr<sim::Engine> own_;
  std::unique_ptr<sim::Engine> rest_;  ///< Null if the host runs all robots.
  std::unique_ptr<sim::WorldAuthority> authority_;
  sim::HostReport own_report_;
  sim::HostReport rest_report_;
  sim::WorldStep world_;
  bool begun_ = false;
};

}  // namespace rave::runtime
