// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "input_log.hpp"
#include "robot_guard.hpp"
#include "roster.hpp"
#include "twin.hpp"
#include "world_truth.hpp"

namespace rave::sim {

class Radio;

/// Where a robot is when its other drivers begin to serve it, as these say.
struct Arrival {
  Pose2 X_WR;
  PoseReading variance;       ///< What the pose source said; nothing if it has not spoken.
  std::optional<Pose2> X_WM;  ///< The frame that its pose source counts in from now on.
  SimTime stamp;
};

/// Robots with two sets of drivers, and the hand-overs between these: opens the other set, listens
/// to it, makes the robot stand, and lets the sets change places between two steps. Program and
/// controllers stay. Belongs to the thread of the engine; sets are opened and closed in threads of
/// their own in a live run. `step` is the one that comes next.
class HandOvers {
 public:
  /// What a change of drivers needs of the engine around it.
  class Site {
   public:
    Site() = default;
    Site(const Site&) = delete;
    Site& operator=(const Site&) = delete;
    virtual ~Site() = default;
    /// Tells hardware to stand that is about to leave.
    virtual void halt(RobotGroup& group) noexcept = 0;
    /// The drivers of the group are others now; its robot is there.
    virtual void drivers_changed(RobotId robot, const Arrival& place) = 0;
    /// The first set serves again, as before the run.
    virtual void drivers_restored(RobotId robot) = 0;
    /// Real drivers get guards with threads of their own, where the run has such.
    [[nodiscard]] virtual Status start_guards(RobotGroup& group) = 0;
    /// Drivers are about to be closed: their errors are reported.
    virtual void before_closing(const RobotGroup& group) const = 0;
    /// False: some do not come to an end.
    [[nodiscard]] virtual bool close_all(std::vector<ToClose> drivers) = 0;
  };

  /// All must outlive it. `spec` changes with the drivers: RobotSpec::type and twin.
  struct Parts {
    EngineSpec& spec;
    Roster& roster;
    WorldTruth& truth;
    std::vector<RobotGuard>& guards;            ///< By robot.
    const std::vector<ReportedPose>& reported;  ///< By robot.
    InputLog& log;
    Site& site;
  };
  explicit HandOvers(const Parts& parts)
      : spec_(parts.spec),
        roster_(parts.roster),
        truth_(parts.truth),
        guards_(parts.guards),
        reported_(parts.reported),
        log_(parts.log),
        site_(parts.site) {}

  /// Finds the robots with two sets. `radio`: for drivers that are made; may be null.
  void make(const Radio* radio);
  /// A run begins.
  void begin() { next_ = 0; }
  /// No robot has two sets.
  [[nodiscard]] bool empty() const noexcept { return twins_.empty(); }

  /// Begins one. Errors: as Engine::hand_over().
  Status ask(std::uint64_t step, RobotId robot, DriverSet to, const Author& author);
  /// Begins what the scenario has for this step, and advances those in progress.
  void advance(std::uint64_t step);
  /// The time until then is none in which a hand-over came to nothing.
  void skip_to(std::uint64_t step);

  /// Null: the robot has one set of drivers.
  [[nodiscard]] const HandOverState* state(RobotId robot) const noexcept;
  [[nodiscard]] bool is_under_way(RobotId robot) const noexcept {
    const HandOverState* const its = state(robot);
    return its != nullptr && its->under_way;
  }
  /// The type of the set that does not serve; null if there is none.
  [[nodiscard]] const RobotType* other_type(RobotId robot) const noexcept;

  /// The first sets serve again, and no hand-over is in progress. Error: kState (drivers that do
  /// not come to an end).
  Status restore();
  /// Ends hand-overs in progress and closes the other sets. Those whose drivers are not done in
  /// time stay as they are, and the log names them; then false.
  [[nodiscard]] bool close() noexcept;
  /// Abandons those that are not done. `keep` receives the types that they use.
  void leave_behind(const std::function<void(const RobotType&)>& keep) noexcept;

 private:
  // hand_overs.cpp: how they come to it
  void set_step(std::uint64_t step) noexcept;
  void begin_scheduled();
  void advance(Twin& twin);
  void close_late(Twin& twin);
  void begin_stage(Twin& twin, Twin::Stage stage);
  [[nodiscard]] Status check(const Twin& twin, DriverSet to) const;
  Status listen(Twin& twin);
  [[nodiscard]] bool is_heard(const Twin& twin) const noexcept;
  [[nodiscard]] bool stands(Twin& twin);
  [[nodiscard]] bool moves_seen(const RobotGroup& group, std::uint32_t robot) const;
  void refuse(Twin& twin, const std::string& why);
  void end(Twin& twin, EventKind kind, std::string text);

  // driver_exchange.cpp: the sets
  Status open_other(Twin& twin);
  void close_other(Twin& twin);
  [[nodiscard]] Arrival arrival(const Twin& twin) const;
  [[nodiscard]] Status check_near(const Twin& twin) const;
  void exchange(Twin& twin);
  void change_drivers(Twin& twin);
  [[nodiscard]] const Twin* find(RobotId robot) const noexcept;
  [[nodiscard]] Twin* find(RobotId robot) noexcept {
    return const_cast<Twin*>(std::as_const(*this).find(robot));
  }
  [[nodiscard]] RobotGroup& group_of(const Twin& twin) noexcept {
    return roster_.group_of(twin.robot);
  }
  [[nodiscard]] static std::string still_busy(const Twin& twin);

  EngineSpec& spec_;
  Roster& roster_;
  WorldTruth& truth_;
  std::vector<RobotGuard>& guards_;
  const std::vector<ReportedPose>& reported_;
  InputLog& log_;
  Site& site_;
  const Radio* radio_ = nullptr;
  std::deque<Twin> twins_;  ///< Deque: threads that open a set use its twin.
  std::size_t next_ = 0;    ///< Of spec.hand_overs.
  std::uint64_t step_ = 0;
  SimTime now_;  ///< Of that step.
};

}  // namespace rave::sim
