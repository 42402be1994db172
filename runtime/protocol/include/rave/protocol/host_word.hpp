// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/bus/writer.hpp"

namespace rave::lock_step {

/// Publishes the state of the run as this host knows it (topic rave/host_run), five times a second
/// while a process reads it. Only monitors do. Destroy it before its bus; thread: that of the bus.
class HostWord {
 public:
  using Clock = std::chrono::steady_clock;

  /// The state of the run for this host.
  struct Facts {
    rave_wire_RunPhase phase = rave_wire_RUN_GATHERING;
    std::uint64_t step = 0;
    std::string_view text{};  ///< What it waits for, or how the run ended.
    bool managed = true;      ///< The run has an Environment Manager; manager_here: it is present.
    bool manager_here = false;
  };

  /// Comes before any tell(). `host`: its number in the scenario. Errors: those of
  /// bus::Writer::open().
  [[nodiscard]] Status open(bus::Bus& bus, std::uint32_t host, std::string name) {
    host_ = host;
    name_ = std::move(name);
    return writer_.open(bus);
  }

  /// Sets the properties of the run from its scenario.
  void describe(std::string scenario, std::uint64_t steps, double step_s);
  /// Sets where the manager leaves its recording: monitors do not hear the manager.
  void place_manager(std::string machine, std::string folder);
  /// Call it often; it publishes when due.
  void tell(const Facts& facts);
  /// Publishes the end of the run at once.
  void tell_end(bool good, std::uint64_t step, std::string_view text);

 private:
  static constexpr std::chrono::milliseconds kInterval{200};
  static constexpr std::chrono::milliseconds kMeasure{1000};

  void write(const Facts& facts);
  void measure(std::uint64_t step, Clock::time_point now);

  bus::Writer<bus::HostRun> writer_;
  std::uint32_t host_ = 0;
  std::string name_;
  std::string scenario_;
  std::string manager_machine_{};
  std::string manager_folder_{};
  std::uint64_t steps_ = 0;
  double step_s_ = 0;
  Clock::time_point next_{};
  Clock::time_point measured_at_{};
  std::uint64_t measured_step_ = 0;
  double speed_ = 0;
};

}  // namespace rave::lock_step
