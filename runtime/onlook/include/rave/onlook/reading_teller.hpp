// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/onlook/asked.hpp"
#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Tells the readings of sensors of one host that are asked for (topic rave/readings): those that
/// are new, and once a second all of them. Must be gone before its bus; thread: that of the bus.
class ReadingTeller {
 public:
  using Clock = std::chrono::steady_clock;

  /// Between two samples.
  static constexpr std::chrono::milliseconds kInterval{33};
  static constexpr std::chrono::seconds kAgain{1};

  /// `host`: its number in the scenario.
  ReadingTeller(bus::Writer<bus::Readings> writer, std::uint32_t host)
      : writer_(std::move(writer)), host_(host) {}

  /// Another number of sensors, or others, are asked for: all are told with the next sample.
  void begin_again() noexcept { again_at_ = {}; }
  /// Sends what is due. Sensors of other hosts and numbers that do not exist are left out. Waits
  /// for nobody. `slower`: so many times rarer than usual, at least 1.
  /// Probes sense the world of the last step for that.
  void tell(const sim::Engine& engine, const Asked& asked, probe::Probes& probes,
            Clock::time_point now, int slower);

 private:
  void put(const sim::Engine& engine, const LookedAt& looked, bool parts);
  void put_commands(const sim::Engine& engine, const LookedAt& looked);
  void put_part(const LookedAt& looked, std::uint8_t part, ReadingKind kind,
                const SampleHeader* header, const void* records);

  bus::Writer<bus::Readings> writer_;
  std::uint32_t host_;
  std::uint64_t number_ = 0;
  Clock::time_point next_{};
  Clock::time_point again_at_{};
  /// By robot, sensor and part: the number of the sample that was told.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, std::uint32_t> told_;
  std::vector<rave_wire_Reading> readings_;
  std::vector<float> values_;
  std::uint32_t left_out_ = 0;
};

}  // namespace rave::onlook
