// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "edit_limits.hpp"
#include "rave/base/log.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::manager {

/// What people ask of a run in lock-step while it goes: becomes inputs of the next step, and is
/// answered when that is made. Orders go to the hosts, which keep the leases of their robots and
/// forward what they accept. Belongs to one thread.
class WorldRequests {
 public:
  /// Nothing is owned; `control` may be null.
  WorldRequests(runtime::RunControl* control, LogSink* log,
                const std::vector<config::PlannedHost>& hosts)
      : control_(control), log_(log), hosts_(hosts) {}
  WorldRequests(const WorldRequests&) = delete;
  WorldRequests& operator=(const WorldRequests&) = delete;
  ~WorldRequests() { end(); }

  /// Requests are taken from here on. `authority` may be in the middle of a run.
  void begin(const sim::WorldAuthority& authority, runtime::RunStatus status);
  void end();

  /// Takes in what was asked, for the step that comes next.
  void listen(sim::WorldAuthority& authority);
  /// The step that it was for is not made for a while, and `why`: callers get an interim answer.
  void put_off(std::string_view why);
  /// A step was made.
  void after_step(const sim::WorldAuthority& authority, const sim::WorldStep& world);
  /// Whether a step may be made now: no request holds the run.
  [[nodiscard]] bool may_step() const { return control_ == nullptr || control_->may_step(); }

 private:
  struct Pending {
    runtime::RunControl::Asked asked;
    std::uint64_t number = 0;  ///< As an input of the world.
    bool obstacle = false;
    std::chrono::steady_clock::time_point since;
  };
  Result<std::uint64_t> pass_on(const request::Request& request, sim::WorldAuthority& authority);
  [[nodiscard]] Status check_released(const sim::WorldAuthority& authority, RobotId robot) const;
  void take(runtime::RunControl::Asked asked, sim::WorldAuthority& authority);
  /// Why a request is for the host of its robot, which keeps the lease; nothing: it is not.
  [[nodiscard]] Status check_for_hosts(const request::Request& request,
                                       const sim::WorldAuthority& authority) const;
  void note_inputs(const sim::WorldStep& world);
  /// Keeps who is stopped, by robot. Returns whether the input stops or releases.
  static bool note_stop(const sim::WorldInput& input, std::vector<std::uint8_t>& stopped);
  void answer(Pending& pending, Result<std::string> text);

  runtime::RunControl* control_;
  LogSink* log_;
  const std::vector<config::PlannedHost>& hosts_;
  bool begun_ = false;
  std::uint64_t next_step_ = 0;
  EditLimits limits_;
  std::vector<Pending> requests_;      ///< For the next step, in order.
  std::vector<std::uint8_t> stopped_;  ///< By robot, as far as it was asked here.
  /// The same, with what waits for the next step.
  std::vector<std::uint8_t> will_be_stopped_;
};

}  // namespace rave::manager
