// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <optional>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

namespace rave::gui_server {

/// The way to a run that is shown. The server's thread; nothing here waits for the run.
class RunPort {
 public:
  virtual ~RunPort() = default;
  /// Why the run cannot be held, stepped, or given another pace; empty: it can.
  [[nodiscard]] virtual std::string why_not_held() const = 0;
  [[nodiscard]] virtual bool paused() const = 0;
  [[nodiscard]] virtual double pace() const = 0;
  virtual void pause() = 0;
  virtual void resume() = 0;
  virtual void step(std::uint64_t count) = 0;
  virtual void set_pace(double factor) = 0;
  /// Which robots are stopped or wait to be armed, by name; nothing if that is not known here.
  [[nodiscard]] virtual std::vector<runtime::RunStatus::Robot> robots() const = 0;
  /// Of a run of this process, which is not on the bus; empty: the run is elsewhere.
  [[nodiscard]] virtual std::optional<runtime::RunStatus> own_status() const { return {}; }
  /// kStop and kRelease. The answer comes later. Error: kState (no run is in progress).
  [[nodiscard]] virtual Result<std::future<Result<std::string>>> post(
      runtime::RunRequest request) = 0;
};

/// A run of this process, or the manager of one.
class LocalPort final : public RunPort {
 public:
  /// `control` outlives it.
  LocalPort(runtime::RunControl& control, std::string why_not_held)
      : control_(control), why_not_held_(std::move(why_not_held)) {}

  [[nodiscard]] std::string why_not_held() const override { return why_not_held_; }
  [[nodiscard]] bool paused() const override { return control_.paused(); }
  [[nodiscard]] double pace() const override { return control_.pace(); }
  void pause() override { control_.pause(); }
  void resume() override { control_.resume(); }
  void step(std::uint64_t count) override { control_.step(count); }
  void set_pace(double factor) override { control_.set_pace(factor); }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override {
    return control_.status().robots;
  }
  [[nodiscard]] std::optional<runtime::RunStatus> own_status() const override {
    return control_.status();
  }
  [[nodiscard]] Result<std::future<Result<std::string>>> post(
      runtime::RunRequest request) override {
    return control_.post(std::move(request));
  }

 private:
  runtime::RunControl& control_;
  std::string why_not_held_;
};

}  // namespace rave::gui_server
