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
  /// The run, whose pace pages see; null: it is elsewhere and keeps its own.
  [[nodiscard]] virtual runtime::RunControl* control() = 0;
  /// Why the run cannot be held, stepped, or given another pace; empty: it can, by control().
  [[nodiscard]] virtual std::string why_not_held() const = 0;
  /// Which robots are stopped or wait to be armed, by name; nothing if that is not known here.
  [[nodiscard]] virtual std::vector<runtime::RunStatus::Robot> robots() const = 0;
  /// Of a run of this process, which is not on the bus; empty: the run is elsewhere.
  [[nodiscard]] virtual std::optional<runtime::RunStatus> own_status() const { return {}; }
  /// kStop and kRelease. The answer comes later. Error: kState (no run is in progress).
  [[nodiscard]] virtual Result<std::future<Result<std::string>>> post(request::Request request) = 0;
};

/// A run of this process, or the manager of one.
class LocalPort final : public RunPort {
 public:
  /// `control` outlives it.
  LocalPort(runtime::RunControl& control, std::string why_not_held)
      : control_(control), why_not_held_(std::move(why_not_held)) {}

  [[nodiscard]] runtime::RunControl* control() override { return &control_; }
  [[nodiscard]] std::string why_not_held() const override { return why_not_held_; }
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override {
    return control_.status().robots;
  }
  [[nodiscard]] std::optional<runtime::RunStatus> own_status() const override {
    return control_.status();
  }
  [[nodiscard]] Result<std::future<Result<std::string>>> post(request::Request request) override {
    return control_.post(std::move(request));
  }

 private:
  runtime::RunControl& control_;
  std::string why_not_held_;
};

}  // namespace rave::gui_server
