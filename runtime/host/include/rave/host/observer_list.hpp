// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/control/order_desk.hpp"
#include "rave/host/input_forwarder.hpp"
#include "rave/host/run.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/recording/record_keeper.hpp"
#include "rave/results/observers.hpp"
#include "rave/ros2_bridge/ros2_face.hpp"
#include "rave/shadow/shadows.hpp"

namespace rave::runtime {

/// Changes of leases, which come between two steps, as events of the step behind them.
class LeaseNotes final : public RunObserver {
 public:
  void add(sim::Event event) { new_.push_back(std::move(event)); }
  void after_step(const StepView& /*step*/) override {
    told_.swap(new_);
    new_.clear();
  }
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override { return told_; }

 private:
  std::vector<sim::Event> new_;
  std::vector<sim::Event> told_;
};

/// All observers of a run, in the order in which they read a step: results, leases, ROS 2,
/// shadows, those of the options, those of the kind of run, and the recording. `run_begins()` is
/// called for all but the recording, which keeps what the others found. README.md of this library
/// says what a new one takes.
class ObserverList {
 public:
  /// What the list is made from. Refers to its parts, which outlive the list.
  struct Parts {
    const config::ExpandedScenario& scenario;  ///< With the history that observers need.
    const std::string& expanded;               ///< The scenario as a file.
    const std::vector<std::string>& robot_kinds;
    const sim::Engine& engine;
    plugin::Catalogue& catalogue;
    const RunOptions& options;
    ConsoleTee& console;
    std::string host{};    ///< Of one of several: its name.
    bool live = false;     ///< In real time.
    bool shadows = false;  ///< Shadows run; not in lock-step over processes.
    /// Those of the kind of run. Not owned; they outlive the list.
    std::vector<RunObserver*> own{};
  };
  /// Opens all observers. Errors: those of an observer that cannot start.
  [[nodiscard]] static Result<std::unique_ptr<ObserverList>> open(const Parts& parts);
  ObserverList(const ObserverList&) = delete;
  ObserverList& operator=(const ObserverList&) = delete;
  ~ObserverList();

  void after_step(const StepView& step);
  /// The run is held.
  void held(const sim::Engine& engine);
  /// After after_step(): calls the observers that need the findings of the others.
  void after_all(const StepView& step);
  /// Adds the findings of the last step to the log and to `all`.
  void tell_found(const sim::Engine& engine, LogSink* log, std::vector<sim::Event>& all) const;

  [[nodiscard]] Observers& results() noexcept { return results_; }
  [[nodiscard]] const Observers& results() const noexcept { return results_; }
  [[nodiscard]] Shadows* shadows() const noexcept { return shadows_.get(); }

  /// Does what a request asks of the run between two steps, or of a shadow, and notes it in the
  /// recording: orders of people if they have the lease of the robot. Returns what was done, for
  /// people.
  Result<std::string> serve(sim::Engine& engine, const request::Request& request);
  /// Ends what people do not renew: drives and leases. Between two steps.
  void tick(sim::Engine& engine);
  /// In real time over several hosts: puts a simulated robot of this host elsewhere, in the world
  /// that this host keeps of it.
  void on_place(std::function<Status(const sim::WorldInput&)> place) { place_ = std::move(place); }
  /// In lock-step over several hosts: passes requests to robots on to the authority of the world.
  /// `forwarder` is not owned and outlives the requests.
  void forward_to(InputForwarder* forwarder) noexcept { forwarder_ = forwarder; }
  /// The request of the last serve() that was passed on and is not done yet.
  [[nodiscard]] std::optional<std::uint64_t> take_given() { return std::exchange(given_, {}); }
  /// Whether a person drives a robot, so that tick() is due often.
  [[nodiscard]] bool drives() const noexcept { return desk_.drives(); }
  /// Robots whose lease has changed since the last call.
  [[nodiscard]] std::set<RobotId> take_leased() { return std::exchange(leased_, {}); }
  /// The holder of a robot's lease, and the page; empty: none.
  [[nodiscard]] std::pair<std::string, std::uint64_t> holder(const std::string& robot) const {
    return {desk_.holder(robot), desk_.page(robot)};
  }
  /// Whether the status of the run changes without a request.
  [[nodiscard]] bool has_orders() const noexcept { return had_orders_; }
  /// Writes the driver of each robot into the status.
  void refresh(RunStatus& status) const;
  /// Notes in the recording what was asked of the run and counts from this step on.
  void keep(const request::Request& request, std::uint64_t step);
  /// Ends the recording. `hash`: none for a live run. Returns why it is incomplete; empty if it is
  /// complete, or if there is no recording.
  [[nodiscard]] std::string end_record(std::optional<std::uint64_t> hash);

 private:
  Result<std::string> place(const sim::Engine& engine, const request::Request& request);
  /// `awaited`: a caller waits for the result.
  Result<std::string> make_input(sim::Engine& engine, const request::Request& request,
                                 bool awaited);
  Result<std::string> serve_order(sim::Engine& engine, const request::Request& request);
  void note_leases(const sim::Engine& engine);
  explicit ObserverList(const Parts& parts);
  Status open_all(const Parts& parts);

  ConsoleTee& console_;
  Observers results_;
  std::unique_ptr<Ros2Face> ros2_;
  std::unique_ptr<Shadows> shadows_;
  LeaseNotes leases_;
  std::unique_ptr<RecordKeeper> record_;
  std::vector<RunObserver*> all_;  ///< These, and those that others own.
  OrderDesk desk_;
  std::function<Status(const sim::WorldInput&)> place_;
  InputForwarder* forwarder_ = nullptr;
  std::optional<std::uint64_t> given_;
  std::set<RobotId> leased_;
  bool had_orders_ = false;
};

}  // namespace rave::runtime
