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

/// A run of several hosts in lock-step once more, in this process: one engine for the host whose
/// record is looked at, one for all others, and the authority between them. Belongs to one thread.
class HostAgain {
 public:
  /// `catalogue` must outlive it. Errors: those of build() and Engine::create(), kNotFound (the
  /// scenario has no such host).
  [[nodiscard]] static Result<std::unique_ptr<HostAgain>> create(
      const config::ExpandedScenario& scenario, const std::string& host,
      plugin::Catalogue& catalogue, const BuildOptions& options);

  /// Asks for something that counts from the next step on, as the host's record says it did.
  /// Returns what was done, for people.
  Result<std::string> ask(const RunRequest& request);
  /// Errors as of Engine::propose(), Engine::apply() and WorldAuthority::step().
  Status step();
  /// Events of the last step that the engine of the host does not have.
  [[nodiscard]] std::vector<sim::Event> beside() const;
  [[nodiscard]] sim::Engine& engine() noexcept { return *own_; }

  /// Called when a step is done, as EngineSpec::on_step_done of the host.
  std::function<void()> look;

 private:
  HostAgain() = default;
  Status propose();

  std::unique_ptr<sim::Engine> own_;
  std::unique_ptr<sim::Engine> rest_;  ///< Null: the host runs all robots.
  std::unique_ptr<sim::WorldAuthority> authority_;
  sim::HostReport own_report_;
  sim::HostReport rest_report_;
  sim::WorldStep world_;
  bool begun_ = false;
};

}  // namespace rave::runtime
