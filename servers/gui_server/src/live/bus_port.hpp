// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "live/run_port.hpp"
#include "rave/control/bus_run.hpp"
#include "rave/control/command_sender.hpp"

namespace rave::gui_server {

/// Stops and releases robots of a run over its bus, in a thread of its own: through each
/// host.
class BusPort final : public RunPort {
 public:
  /// `bus`, `status`: two ends of the bus of the run, for requests and for questions. Orders have a
  /// third, of `config`. `robots`: the names of all, by id. `host_of`: the name of the host of each
  /// robot. Errors: those of control::CommandSender::open().
  [[nodiscard]] static Result<std::unique_ptr<BusPort>> open(
      std::unique_ptr<control::BusRun> bus, std::unique_ptr<control::BusRun> status,
      const bus::BusConfig& config, const std::vector<std::string>& robots,
      std::map<std::string, std::string> host_of);
  BusPort(const BusPort&) = delete;
  BusPort& operator=(const BusPort&) = delete;
  ~BusPort() override;

  [[nodiscard]] runtime::RunControl* control() override { return nullptr; }
  [[nodiscard]] std::string why_not_held() const override {
    return "Only the process that manages the run can pause it: `rave run --gui` does.";
  }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(runtime::RunRequest request) override;

 private:
  using Answer = Result<std::string>;

  BusPort(std::unique_ptr<control::BusRun> bus, std::unique_ptr<control::BusRun> status,
          std::map<std::string, std::string> host_of)
      : bus_(std::move(bus)), status_(std::move(status)), host_of_(std::move(host_of)) {}

  void work(const std::stop_token& stop);
  void watch(const std::stop_token& stop);
  [[nodiscard]] Answer ask(const runtime::RunRequest& request);
  /// What only the host of the robot can do.
  [[nodiscard]] Answer ask_host(const std::string& host, const control::Request& request);
  /// A drive gets no answer; now and then its robot is asked whether it listens to this driver.
  [[nodiscard]] Result<std::future<Answer>> drive(const runtime::RunRequest& request);
  /// Lets watch() ask for the robots soon.
  void stir();
  [[nodiscard]] Result<std::future<Answer>> queue(runtime::RunRequest request);

  std::unique_ptr<control::BusRun> bus_;
  std::unique_ptr<control::BusRun> status_;
  const std::map<std::string, std::string> host_of_;  ///< By robot.
  /// By robot; of the server's thread.
  std::map<std::string, std::chrono::steady_clock::time_point> asked_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::pair<runtime::RunRequest, std::promise<Answer>>> waiting_;
  std::vector<runtime::RunStatus::Robot> robots_;
  bool stirred_ = false;  ///< Something was done, so that `robots_` are to be asked for again.
  std::unique_ptr<control::CommandSender> commands_;
  std::jthread thread_;
  std::jthread watcher_;
};

/// A run in lock-step whose Environment Manager is in this process: hosts take orders, the manager
/// takes the rest.
class ManagedPort final : public RunPort {
 public:
  /// `control`: of the manager; outlives it.
  ManagedPort(runtime::RunControl& control, std::unique_ptr<BusPort> hosts)
      : manager_(control), hosts_(std::move(hosts)) {}

  [[nodiscard]] runtime::RunControl* control() override { return &manager_; }
  [[nodiscard]] std::string why_not_held() const override { return ""; }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(runtime::RunRequest request) override;

 private:
  runtime::RunControl& manager_;
  std::unique_ptr<BusPort> hosts_;
};

}  // namespace rave::gui_server
