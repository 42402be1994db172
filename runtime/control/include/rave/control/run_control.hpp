// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave::runtime {

/// What somebody asks of a run between two of its steps.
struct RunRequest {
  enum class Kind : std::uint8_t {
    kStop,
    kRelease,
    kArm,
    kSet,
    kAdd,     ///< An obstacle.
    kMove,    ///< The same.
    kRemove,  ///< The same.
    kList,    ///< Which obstacles there are; changes nothing.
    kHandOver,
    kResetShadow,  ///< Of one robot, or of all.
    // Orders; each needs a robot, and a person needs its lease.
    kDrive,   ///< A velocity, in the place of what the program gives to velocity controllers.
    kGoal,    ///< A place to go to.
    kPath,    ///< A line to follow.
    kCancel,  ///< Ends the order under way. Without a robot: of all robots.
    kText,    ///< Words for the program.
    kPlace,   ///< Puts a simulated robot elsewhere.
    // Leases; each needs a robot.
    kTake,
    kGive,
    /// Something was said that belongs into the record: `chat_line()`. No input of the run.
    kChat,
  };
  Kind kind = Kind::kStop;
  std::string robot;  ///< Empty: all of them, except of orders and leases.
  /// kSet: such as `program.max_speed_mps`. kRemove: the name of the obstacle.
  std::string key = {};
  /// kHandOver: `real`, `simulated`, `first` or `twin`. kSet: as in a file. kAdd, kMove: YAML, an
  /// entry of `obstacles:`, or of `move_obstacle:`. kText: the text, at most 1000 bytes of UTF-8.
  /// kGive: the new holder; empty: nobody. kTake: empty (refused with the name of the holder if
  /// somebody else has the lease) or `force` (takes it, and the former holder is told).
  std::string value = {};
  /// Who asks: the name of a person. Empty: the terminal of this machine, a super-user.
  std::string by = {};
  /// Asked by a super-user, who needs no lease for a release and may take one without asking.
  bool overrides = false;
  /// On which of the pages that the person has open; 0: on none, as a script. Of leases alone.
  std::uint64_t page = 0;
  std::vector<Vec2> points = {};  ///< kGoal, kPlace: one. kPath: 2 to 1000. World frame, m.
  std::optional<double> yaw_rad = std::nullopt;  ///< kGoal, kPlace: none: as it comes.
  double v_mps = 0;                              ///< kDrive: forward.
  double w_radps = 0;                            ///< kDrive: to the left.
  double speed_mps = 0;                          ///< kGoal, kPath: 0: as the robot likes.
};

/// `stop`, `release`, `arm`, `set`, `add`, `move`, `remove`, `list`, `hand_over`, `reset_shadow`,
/// `drive`, `goal`, `path`, `cancel`, `text`, `place`, `take` or `give`; and back, nothing for any
/// other word.
[[nodiscard]] std::string_view to_string(RunRequest::Kind kind) noexcept;
[[nodiscard]] std::optional<RunRequest::Kind> request_kind(std::string_view word) noexcept;

/// What can be seen of a run from outside.
struct RunStatus {
  /// How it stands with a robot that has two sets of drivers; sim::HandOverState.
  struct HandOver {
    bool under_way = false;
    std::uint32_t made = 0;
    std::uint32_t refused = 0;
    std::string last;
    double x_m = 0;  ///< Where the robot is, which the drivers that it is given have to say too.
    double y_m = 0;
    double yaw_rad = 0;
    friend bool operator==(const HandOver&, const HandOver&) = default;
  };
  /// How far a real robot and its shadow are from each other.
  struct Shadow {
    struct Reading {
      std::string sensor;
      std::string unit;  ///< `m` or `share`.
      double last = 0;
      double most = 0;
      friend bool operator==(const Reading&, const Reading&) = default;
    };
    bool running = false;
    double since_s = 0;  ///< When it was put where the robot was.
    double m = 0;
    double rad = 0;
    double most_m = 0;
    double most_rad = 0;
    std::vector<Reading> readings;
    /// From the robot to the shadow when they were compared last, axes of W; none so far: nothing.
    std::optional<Pose2> offset_W = std::nullopt;
    friend bool operator==(const Shadow&, const Shadow&) = default;
  };
  struct Robot {
    std::string name;
    bool simulated = true;
    bool armed = true;
    bool stopped = false;
    std::optional<HandOver> hand_over = std::nullopt;
    std::optional<Shadow> shadow = std::nullopt;
    std::string lease = {};               ///< Who drives it; empty: nobody.
    std::uint64_t lease_page = 0;         ///< On which page of theirs; 0: on none in particular.
    std::vector<std::string> takes = {};  ///< Of `drive`, `goal`, `path`, `text`, `place`.
    /// The order under way, for people, such as `goal 1.20, 3.40`; empty: none.
    std::string order = {};
  };
  std::string scenario;
  double sim_s = 0;
  double duration_s = 0;
  double pace = 1;  ///< Simulated seconds per second; 0: as fast as it can.
  bool live = false;
  bool paused = false;
  /// A host that goes as its environment manager says, which alone can hold it.
  bool follows = false;
  std::string waits_for;  ///< Hosts without which it does not go on; empty: none.
  /// How a run with a pace keeps its deadlines.
  struct Lateness {
    std::uint64_t deadlines = 0;  ///< That have passed.
    std::uint64_t missed = 0;
    double worst_s = 0;
    double behind_s = 0;  ///< How late its last step was.
    std::string phase;    ///< Most to blame; empty: nothing was missed.
    friend bool operator==(const Lateness&, const Lateness&) = default;
  };
  std::vector<Robot> robots;
  std::optional<Lateness> lateness = std::nullopt;  ///< None: it has no pace.
};

/// The handle on a run while it goes: pause, single steps, end, requests. May be used from any
/// thread; stop() also from a signal handler. Outlives the run.
class RunControl {
 public:
  /// Ends the run before its next step; its results are written. Async-signal-safe.
  void stop() noexcept { stop_.store(true); }
  /// The same for all processes of the run, if this is its environment manager in real time: else
  /// that leaves the hosts to their run.
  void end_run() noexcept {
    everybody_.store(true);
    stop();
  }
  /// Holds the run before its next step. A live run cannot be held: the world outside goes on.
  void pause();
  /// Lets a paused run go on.
  void resume();
  /// Does `count` steps of a paused run, which then is paused again.
  void step(std::uint64_t count = 1);

  /// Another pace from the next step on, of a run that has one process and is not live: simulated
  /// seconds per second, 0: as fast as it can.
  void set_pace(double factor);

  /// What the pace is, or will be with the next step.
  [[nodiscard]] double pace() const;
  [[nodiscard]] bool stopping() const noexcept { return stop_.load(); }
  [[nodiscard]] bool ends_everybody() const noexcept { return everybody_.load(); }
  [[nodiscard]] bool paused() const;

  /// Makes robots stand until they are released; lets them go; arms them; changes a parameter or
  /// an obstacle.
  /// Waits until the run has done it, which is before its next step, also while it is paused.
  /// Returns what was done, for people. Errors: kNotFound and kInvalidArgument (what the run says),
  /// kState (no run is under way), kTimeout (it has not come to it in `patience`; it will).
  Result<std::string> ask(RunRequest request,
                          std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// The same without waiting: the answer comes when the run has done it. Error kState.
  Result<std::future<Result<std::string>>> post(RunRequest request);
  /// What the run looks like now; without a scenario before it has begun and when it has ended.
  [[nodiscard]] RunStatus status() const;

  // For the run.
  /// Something that was asked and is not answered yet. The asker waits for answer(), which may be
  /// called once; who is never answered is told that the run has ended.
  class Asked {
   public:
    Asked(RunRequest request, std::promise<Result<std::string>> promise,
          std::chrono::steady_clock::time_point since)
        : request_(std::move(request)), promise_(std::move(promise)), since_(since) {}
    Asked(Asked&& other) noexcept;
    Asked& operator=(Asked&& other) noexcept;
    ~Asked();
    [[nodiscard]] const RunRequest& request() const noexcept { return request_; }
    /// When it was asked.
    [[nodiscard]] std::chrono::steady_clock::time_point since() const noexcept { return since_; }
    void answer(Result<std::string> text);

   private:
    RunRequest request_;
    std::promise<Result<std::string>> promise_;
    std::chrono::steady_clock::time_point since_;
    bool open_ = true;
  };
  /// What set_pace() asked for since the last call.
  [[nodiscard]] std::optional<double> take_pace();
  /// All that was asked since the last call, in order, for a run that answers later.
  [[nodiscard]] std::vector<Asked> take();
  /// Wakes who waits for something else, with the next request since take().
  [[nodiscard]] std::stop_token asked() const;
  /// Whether a step may be done now; counts the single steps of a run that is held.
  [[nodiscard]] bool may_step();
  using Serve = std::function<Result<std::string>(const RunRequest&)>;
  /// Requests are taken from here on.
  void begin(RunStatus status);
  /// Answers what was asked, in order; `robots` brings the status up to date when something was.
  void serve(const Serve& serve, const std::function<void(RunStatus&)>& refresh);
  /// Keeps what was said for who writes the record, where the run itself writes none.
  void keep_said(RunRequest chat);
  [[nodiscard]] std::vector<RunRequest> take_said();
  /// Brings the status up to date though nothing was asked.
  void refresh(const std::function<void(RunStatus&)>& refresh);
  /// Says for which hosts the run waits, in its status.
  void set_waits_for(std::string hosts);
  void set_time(double sim_s) noexcept { sim_s_.store(sim_s); }
  /// No more requests; those that wait get an error.
  void end();
  /// Waits until a step may be done, serving requests, and calling `held` now and then meanwhile;
  /// false: the run is to end.
  bool wait_for_turn(const std::function<void()>& serve = {},
                     const std::function<void()>& held = {});

 private:
  struct Pending {
    RunRequest request;
    std::promise<Result<std::string>> answer;
    std::chrono::steady_clock::time_point since;
  };
  std::atomic<bool> stop_{false};
  std::atomic<bool> everybody_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
  std::atomic<bool> asked_{false};
  std::atomic<bool> said_something_{false};
  std::atomic<double> pace_asked_{-1};  ///< Negative: none.
  std::atomic<double> sim_s_{0};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool paused_ = false;
  bool running_ = false;
  std::uint64_t steps_ = 0;  ///< Single steps still to be done.
  std::deque<Pending> pending_;
  std::vector<RunRequest> said_;
  std::stop_source wake_;  ///< Of asked().
  RunStatus status_;
};

}  // namespace rave::runtime
