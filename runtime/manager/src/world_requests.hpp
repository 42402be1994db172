// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "edit_limits.hpp"
#include "rave/base/log.hpp"
#include "rave/control/order_desk.hpp"
#include "rave/control/run_control.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::manager {

/// What people ask of a run in lock-step while it goes: becomes inputs of the next step, and is
/// answered when that is made; orders when the hosts have said what they refuse, a step later. It
/// keeps the leases of all robots, since it numbers what they are asked. Belongs to one thread.
class WorldRequests {
 public:
  /// Neither is owned; both may be null.
  WorldRequests(runtime::RunControl* control, LogSink* log) : control_(control), log_(log) {}
  WorldRequests(const WorldRequests&) = delete;
  WorldRequests& operator=(const WorldRequests&) = delete;
  ~WorldRequests() { end(); }

  /// Requests are taken from here on. `authority` may be in the middle of a run.
  void begin(const sim::WorldAuthority& authority, runtime::RunStatus status);
  void end();

  /// Takes in what was asked, for the step that comes next.
  void listen(sim::WorldAuthority& authority);
  /// The step that it was for is not made for a while, and `why`: who asked is told what will be.
  void put_off(std::string_view why);
  /// A step was made.
  void after_step(const sim::WorldAuthority& authority, const sim::WorldStep& world);
  /// Whether a step may be made now: nobody holds the run.
  [[nodiscard]] bool may_step() const { return control_ == nullptr || control_->may_step(); }

 private:
  struct Pending {
    runtime::RunControl::Asked asked;
    std::uint64_t number = 0;  ///< As an input of the world.
    bool obstacle = false;
    bool order = false;  ///< A host may refuse it.
    bool told = false;   ///< The hosts know it.
    std::chrono::steady_clock::time_point since;
  };
  Result<std::uint64_t> pass_on(const runtime::RunRequest& request, sim::WorldAuthority& authority);
  [[nodiscard]] Status check_released(const sim::WorldAuthority& authority, RobotId robot) const;
  void take(runtime::RunControl::Asked asked, sim::WorldAuthority& authority);
  /// Orders and leases.
  void take_order(runtime::RunControl::Asked asked, sim::WorldAuthority& authority);
  [[nodiscard]] bool is_driven(const sim::WorldAuthority& authority,
                               const std::string& robot) const;
  void tell_leases();
  void note_inputs(const sim::WorldAuthority& authority, const sim::WorldStep& world);
  void note_order(const sim::WorldInput& input);
  /// Keeps who is stopped, by robot. Returns whether the input stops or releases.
  static bool note_stop(const sim::WorldInput& input, std::vector<std::uint8_t>& stopped);
  void show_orders(runtime::RunStatus& status) const;
  void answer(Pending& pending, Result<std::string> text);

  runtime::RunControl* control_;
  LogSink* log_;
  bool begun_ = false;
  std::uint64_t next_step_ = 0;
  EditLimits limits_;
  std::vector<Pending> requests_;      ///< For the next step, in order.
  std::vector<std::uint8_t> stopped_;  ///< By robot, as far as it was asked here.
  /// The same, with what waits for the next step.
  std::vector<std::uint8_t> will_be_stopped_;
  runtime::OrderDesk desk_;
  std::vector<std::string> orders_;           ///< By robot: what people asked last, for people.
  std::vector<std::uint64_t> order_numbers_;  ///< By robot: of that.
};

}  // namespace rave::manager
