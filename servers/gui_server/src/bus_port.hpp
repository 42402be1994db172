// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "rave/run_control/bus_run.hpp"
#include "run_port.hpp"

namespace rave::gui_server {

/// Stops and releases robots of a run over its bus, in a thread of its own: through each
/// host.
class BusPort final : public RunPort {
 public:
  explicit BusPort(std::unique_ptr<run_control::BusRun> bus);
  BusPort(const BusPort&) = delete;
  BusPort& operator=(const BusPort&) = delete;
  ~BusPort() override;

  [[nodiscard]] std::string why_not_held() const override {
    return "Only the process that manages the run can hold it: `rave run --gui` does.";
  }
  [[nodiscard]] bool paused() const override { return false; }
  [[nodiscard]] double pace() const override { return 1; }
  void pause() override {}
  void resume() override {}
  void step(std::uint64_t /*count*/) override {}
  void set_pace(double /*factor*/) override {}
  [[nodiscard]] Result<std::future<Result<std::string>>> post(
      robot_host::RunRequest request) override;

 private:
  using Answer = Result<std::string>;

  void work(const std::stop_token& stop);
  [[nodiscard]] Answer ask(const robot_host::RunRequest& request);

  std::unique_ptr<run_control::BusRun> bus_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::pair<robot_host::RunRequest, std::promise<Answer>>> waiting_;
  std::jthread thread_;
};

}  // namespace rave::gui_server
