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
#include "rave/request/request.hpp"

namespace rave::runtime {

/// The state of a run for observers.
struct RunStatus {
  /// The hand-over state of a robot with two sets of drivers; see sim::HandOverState.
  struct HandOver {
    bool under_way = false;
    std::uint32_t made = 0;
    std::uint32_t refused = 0;
    std::string last;
    double x_m = 0;  ///< Present pose of the robot. A hand-over requires that the other drivers
                     ///< report it too.
    double y_m = 0;
    double yaw_rad = 0;
    friend bool operator==(const HandOver&, const HandOver&) = default;
  };
  /// The difference between a real robot and its shadow.
  struct Shadow {
    struct Reading {
      std::string sensor;
      std::string unit;  ///< `m`, or `share` for a fraction.
      double last = 0;
      double most = 0;
      friend bool operator==(const Reading&, const Reading&) = default;
    };
    bool running = false;
    double since_s = 0;  ///< Simulation time of its last reset to the robot's pose.
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
    /// Whether it may move is known to its host only, not to this process.
    bool elsewhere = false;
    /// What else keeps it from moving, such as a silent sensor; empty: nothing.
    std::string lacks = {};
    std::optional<HandOver> hand_over = std::nullopt;
    std::optional<Shadow> shadow = std::nullopt;
    std::string lease = {};        ///< Holder of the command lease; empty: none.
    std::uint64_t lease_page = 0;  ///< Page of the holder; 0: no particular one.
    /// Kinds of orders: some of `drive`, `goal`, `path`, `text`, `place`.
    std::vector<std::string> takes = {};
    /// The current order in words, such as `goal 1.20, 3.40`; empty: none.
    std::string order = {};
    /// Parameters with other values than in the scenario: key and value as `rave set` takes them.
    std::vector<std::pair<std::string, std::string>> changed = {};
    friend bool operator==(const Robot&, const Robot&) = default;
  };
  std::string scenario;
  /// Of a run of several processes: its id, the same in all of them; else empty.
  std::string run = {};
  double sim_s = 0;
  double duration_s = 0;  ///< 0: an open end.
  double pace = 1;        ///< Simulated seconds per second; 0: no limit.
  bool live = false;
  bool paused = false;
  /// A host that follows its Environment Manager; only the latter can pause it.
  bool follows = false;
  std::string waits_for;  ///< Hosts that the run waits for; empty: none.
  /// Missed deadlines of a run with a pace.
  struct Lateness {
    std::uint64_t deadlines = 0;  ///< Number of passed deadlines.
    std::uint64_t missed = 0;
    double worst_s = 0;
    double behind_s = 0;  ///< Delay of the last step.
    std::string phase;    ///< Phase that caused most of the misses; empty: nothing was missed.
    friend bool operator==(const Lateness&, const Lateness&) = default;
  };
  std::vector<Robot> robots;
  std::optional<Lateness> lateness = std::nullopt;  ///< Empty: the run has no pace.
};

/// Controls a run in progress: pause, single steps, end, requests. Thread-safe; stop() may also be
/// called from a signal handler. Must outlive the run.
class RunControl {
 public:
  /// Ends the run before its next step; results are still written. Async-signal-safe.
  void stop() noexcept { stop_.store(true); }
  /// Ends all processes of the run. Only for an Environment Manager in real time: stop() alone lets
  /// its hosts continue.
  void end_run() noexcept {
    everybody_.store(true);
    stop();
  }
  /// Pauses the run before its next step. A live run cannot be paused, because the real world
  /// continues.
  void pause();
  /// Resumes a paused run.
  void resume();
  /// Executes `count` steps of a paused run, which then is paused again.
  void step(std::uint64_t count = 1);

  /// Sets the pace from the next step on, for a run with one process that is not live: simulated
  /// seconds per second, 0: no limit.
  void set_pace(double factor);

  /// The pace, including a change that is still to take effect.
  [[nodiscard]] double pace() const;
  [[nodiscard]] bool stopping() const noexcept { return stop_.load(); }
  [[nodiscard]] bool ends_everybody() const noexcept { return everybody_.load(); }
  [[nodiscard]] bool paused() const;

  /// Whether a run may start as this asks. `live_reason`: why it is live; empty: it is not. Error
  /// kInvalidArgument: it is live, and to start paused.
  [[nodiscard]] Status check_start(std::string_view live_reason) const;

  /// Executes a request and waits until the run has done so, which is before its next step, also
  /// while it is paused. Returns a description of what was done. Errors: kNotFound and
  /// kInvalidArgument (those of the run), kState (no run in progress), kTimeout (not executed
  /// within `patience`; it will be later).
  Result<std::string> ask(request::Request request,
                          std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// Like ask(), without waiting: the future is set when the run has executed the request. Error
  /// kState.
  Result<std::future<Result<std::string>>> post(request::Request request);
  /// The present state; without a scenario before the run has begun and after it has ended.
  [[nodiscard]] RunStatus status() const;
  /// Why requests are refused: the run has not begun yet, or has ended. Empty while it serves them.
  [[nodiscard]] std::string_view idle() const;

  // The functions below are for the run.
  /// A request that is not answered yet. answer() may be called once; the destructor answers that
  /// the run has ended.
  class Asked {
   public:
    Asked(request::Request request, std::promise<Result<std::string>> promise,
          std::chrono::steady_clock::time_point since)
        : request_(std::move(request)), promise_(std::move(promise)), since_(since) {}
    Asked(Asked&& other) noexcept;
    Asked& operator=(Asked&& other) noexcept;
    ~Asked();
    [[nodiscard]] const request::Request& request() const noexcept { return request_; }
    /// Time of the request.
    [[nodiscard]] std::chrono::steady_clock::time_point since() const noexcept { return since_; }
    void answer(Result<std::string> text);

   private:
    request::Request request_;
    std::promise<Result<std::string>> promise_;
    std::chrono::steady_clock::time_point since_;
    bool open_ = true;
  };
  /// The argument of set_pace() since the last call, if any.
  [[nodiscard]] std::optional<double> take_pace();
  /// All requests since the last call, in order, for a run that answers later.
  [[nodiscard]] std::vector<Asked> take();
  /// Signals the next request after take(), to wake a thread that waits for something else.
  [[nodiscard]] std::stop_token asked() const;
  /// Whether a step may be computed now; counts the single steps of a paused run.
  [[nodiscard]] bool may_step();
  using Serve = std::function<Result<std::string>(const request::Request&)>;
  /// Requests are accepted from now on.
  void begin(RunStatus status);
  /// Executes the pending requests in order; if there were any, `refresh` updates the status.
  void serve(const Serve& serve, const std::function<void(RunStatus&)>& refresh);
  /// Like serve(), for a run that answers some requests later: `serve` then moves the request away
  /// and returns nothing.
  using ServeOrKeep = std::function<std::optional<Result<std::string>>(Asked&)>;
  void serve_or_keep(const ServeOrKeep& serve, const std::function<void(RunStatus&)>& refresh);
  /// Keeps a chat message for the process that writes the recording, if that is not the run itself.
  void keep_said(request::Request chat);
  [[nodiscard]] std::vector<request::Request> take_said();
  /// Updates the status without a request.
  void refresh(const std::function<void(RunStatus&)>& refresh);
  /// Sets the hosts that the run waits for, in its status.
  void set_waits_for(std::string hosts);
  void set_time(double sim_s) noexcept { sim_s_.store(sim_s); }
  /// Accepts no more requests; pending ones get an error.
  void end();
  /// Waits until a step may be computed. Meanwhile executes requests and calls `held` repeatedly.
  /// Returns false if the run must end.
  bool wait_for_turn(const std::function<void()>& serve = {},
                     const std::function<void()>& held = {});

 private:
  struct Pending {
    request::Request request;
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
  std::string_view idle_ = "the run has not begun yet";  ///< Why nothing is served; empty: it is.
  std::uint64_t steps_ = 0;                              ///< Number of single steps to execute.
  std::deque<Pending> pending_;
  std::vector<request::Request> said_;
  std::stop_source wake_;  ///< The source of asked().
  RunStatus status_;
};

}  // namespace rave::runtime
