// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "live/request_lane.hpp"
#include "live/run_port.hpp"
#include "rave/control/bus_run.hpp"
#include "rave/control/command_sender.hpp"

namespace rave::gui_server {

/// The way to a run over its bus: to its hosts, which forward what only the Environment Manager can
/// do. Stops do not wait for other requests.
class BusPort final : public RunPort {
 public:
  /// `bus`: as the server joins it, a monitor. `lock_step`: the run is not in real time. `robots`:
  /// the names of all, by id. `host_of`: the name of the host of each robot. Errors: those of
  /// control::CommandSender::open() and RequestLane::open().
  [[nodiscard]] static Result<std::unique_ptr<BusPort>> open(
      const bus::BusConfig& bus, bool lock_step, const std::vector<std::string>& robots,
      std::map<std::string, std::string> host_of);
  BusPort(const BusPort&) = delete;
  BusPort& operator=(const BusPort&) = delete;
  ~BusPort() override;

  [[nodiscard]] RunHold held() const override;
  [[nodiscard]] std::string why_not_held() const override {
    return lock_step_ ? "" : "A run in real time cannot be paused.";
  }
  void hold(const TransportMessage& transport) override;
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(request::Request request) override;

 private:
  using Answer = Result<std::string>;

  BusPort(std::unique_ptr<control::BusRun> status, bool lock_step,
          std::map<std::string, std::string> host_of)
      : status_(std::move(status)), lock_step_(lock_step), host_of_(std::move(host_of)) {}

  void watch(const std::stop_token& stop);
  [[nodiscard]] Answer ask(control::BusRun& bus, const request::Request& request);
  /// Carries out a request of a page in a lane.
  [[nodiscard]] std::future<Answer> send(RequestLane& lane,
                                         Answer (BusPort::*how)(control::BusRun&,
                                                                const request::Request&),
                                         request::Request request);
  /// Stops, releases or arms all robots.
  [[nodiscard]] Answer hold_all(control::BusRun& bus, const request::Request& request);
  /// What only the manager does, by way of a host: that of the robot, or any.
  [[nodiscard]] Answer ask_manager(control::BusRun& bus, const std::string& robot,
                                   control::Request request);
  /// A drive gets no answer; now and then its robot is asked whether it listens to this driver.
  [[nodiscard]] Result<std::future<Answer>> drive(const request::Request& request);
  /// Lets watch() ask for the robots soon.
  void stir();

  std::unique_ptr<control::BusRun> status_;
  const bool lock_step_;
  const std::map<std::string, std::string> host_of_;  ///< By robot.
  /// By robot; of the server's thread.
  std::map<std::string, std::chrono::steady_clock::time_point> asked_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<runtime::RunStatus::Robot> robots_;
  RunHold hold_;                   ///< As the manager said last, or a page asked since.
  std::uint64_t holds_asked_ = 0;  ///< Requests of pages that the manager has not answered.
  bool stirred_ = false;  ///< Something was done, so that `robots_` are to be asked for again.
  std::unique_ptr<control::CommandSender> commands_;
  std::unique_ptr<RequestLane>
      holds_;  ///< Of all robots; apart, so that no other request delays them.
  std::unique_ptr<RequestLane> requests_;
  std::jthread watcher_;
};

/// A run in lock-step whose Environment Manager is in this process: hosts take orders, the manager
/// takes the rest.
class ManagedPort final : public RunPort {
 public:
  /// `control`: of the manager; outlives it.
  ManagedPort(runtime::RunControl& control, std::unique_ptr<BusPort> hosts)
      : manager_(control), hosts_(std::move(hosts)) {}

  [[nodiscard]] RunHold held() const override { return gui_server::held(manager_); }
  [[nodiscard]] std::string why_not_held() const override { return ""; }
  void hold(const TransportMessage& transport) override { gui_server::hold(manager_, transport); }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(request::Request request) override;

 private:
  runtime::RunControl& manager_;
  std::unique_ptr<BusPort> hosts_;
};

}  // namespace rave::gui_server
