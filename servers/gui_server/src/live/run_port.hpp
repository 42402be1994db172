// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <optional>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// How the time of a run goes.
struct RunHold {
  bool paused = false;
  std::optional<double> pace{};
};

[[nodiscard]] inline RunHold held(const runtime::RunControl& run) {
  return {run.paused(), run.pace()};
}
/// See RunPort::hold().
void hold(runtime::RunControl& run, const TransportMessage& transport);

/// The way to a run that is shown. The server's thread; nothing here waits for the run.
class RunPort {
 public:
  virtual ~RunPort() = default;
  /// Whether the run is paused, and its pace; as far as that is known here.
  [[nodiscard]] virtual RunHold held() const = 0;
  /// Why the run cannot be held, stepped, or given another pace; empty: it can, by hold().
  [[nodiscard]] virtual std::string why_not_held() const = 0;
  /// Pauses, steps, continues or paces the run: all but kSeek. kPace: 0 is no limit.
  virtual void hold(const TransportMessage& transport) = 0;
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

  [[nodiscard]] RunHold held() const override { return gui_server::held(control_); }
  void hold(const TransportMessage& transport) override { gui_server::hold(control_, transport); }
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
