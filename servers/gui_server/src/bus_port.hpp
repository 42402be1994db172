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

#include "command_line.hpp"
#include "rave/control/bus_run.hpp"
#include "run_port.hpp"

namespace rave::gui_server {

/// Stops and releases robots of a run over its bus, in a thread of its own: through each
/// host.
class BusPort final : public RunPort {
 public:
  /// Two ends of the bus of the run; `commands`: the way of drives, which may be null.
  /// `host_of`: the name of the host of each robot.
  BusPort(std::unique_ptr<control::BusRun> bus, std::unique_ptr<control::BusRun> status,
          std::unique_ptr<CommandLine> commands, std::map<std::string, std::string> host_of);
  /// Once. Error kIo: the system grants no thread.
  [[nodiscard]] Status start();
  BusPort(const BusPort&) = delete;
  BusPort& operator=(const BusPort&) = delete;
  ~BusPort() override;

  [[nodiscard]] std::string why_not_held() const override {
    return "Only the process that manages the run can pause it: `rave run --gui` does.";
  }
  [[nodiscard]] bool paused() const override { return false; }
  [[nodiscard]] double pace() const override { return 1; }
  void pause() override {}
  void resume() override {}
  void step(std::uint64_t /*count*/) override {}
  void set_pace(double /*factor*/) override {}
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(runtime::RunRequest request) override;

 private:
  using Answer = Result<std::string>;

  void work(const std::stop_token& stop);
  void watch(const std::stop_token& stop);
  [[nodiscard]] Answer ask(const runtime::RunRequest& request);
  /// What only the host of the robot can do.
  [[nodiscard]] Answer ask_host(const std::string& host, const control::Request& request);
  /// A drive goes at once, by the topic without answers; now and then its robot is asked
  /// whether it listens to this driver.
  [[nodiscard]] Result<std::future<Answer>> drive(const runtime::RunRequest& request);
  [[nodiscard]] Result<std::future<Answer>> queue(runtime::RunRequest request);

  std::unique_ptr<control::BusRun> bus_;
  std::unique_ptr<control::BusRun> status_;
  std::unique_ptr<CommandLine> commands_;                               ///< Of the server's thread.
  const std::map<std::string, std::string> host_of_;                    ///< By robot.
  std::map<std::string, std::chrono::steady_clock::time_point> asked_;  ///< By robot; the same.
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::pair<runtime::RunRequest, std::promise<Answer>>> waiting_;
  std::vector<runtime::RunStatus::Robot> robots_;
  bool stirred_ = false;  ///< Something was done, so that `robots_` are to be asked for again.
  std::jthread thread_;
  std::jthread watcher_;
};

/// A run in lock-step whose Environment Manager is in this process: hosts take orders, the manager
/// takes the rest.
class ManagedPort final : public RunPort {
 public:
  /// `control`: of the manager; outlives it.
  ManagedPort(runtime::RunControl& control, std::unique_ptr<BusPort> hosts)
      : manager_(control, ""), hosts_(std::move(hosts)) {}

  [[nodiscard]] std::string why_not_held() const override { return manager_.why_not_held(); }
  [[nodiscard]] bool paused() const override { return manager_.paused(); }
  [[nodiscard]] double pace() const override { return manager_.pace(); }
  void pause() override { manager_.pause(); }
  void resume() override { manager_.resume(); }
  void step(std::uint64_t count) override { manager_.step(count); }
  void set_pace(double factor) override { manager_.set_pace(factor); }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override;
  [[nodiscard]] Result<std::future<Result<std::string>>> post(runtime::RunRequest request) override;

 private:
  LocalPort manager_;
  std::unique_ptr<BusPort> hosts_;
};

}  // namespace rave::gui_server
