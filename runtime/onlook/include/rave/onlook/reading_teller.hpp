// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/onlook/asked.hpp"
#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Publishes the requested sensor readings of one host (topic rave/readings): new ones as they
/// come, and all once a second. Destroy it before its bus; thread: that of the bus.
class ReadingTeller {
 public:
  using Clock = std::chrono::steady_clock;

  /// Time between two samples.
  static constexpr std::chrono::milliseconds kInterval{33};
  static constexpr std::chrono::seconds kAgain{1};

  /// `host`: its number in the scenario.
  ReadingTeller(bus::Writer<bus::Readings> writer, std::uint32_t host)
      : writer_(std::move(writer)), host_(host) {}

  /// Call it when the requested sensors change: the next sample contains all of them.
  void begin_again() noexcept { again_at_ = {}; }
  /// Sends the readings that are due. Sensors of other hosts and unknown ids are ignored. Does not
  /// block. `slower`: factor of the interval, at least 1. Probes sense the world of the last step
  /// when called.
  void tell(const sim::Engine& engine, const Asked& asked, probe::Probes& probes,
            Clock::time_point now, int slower);

 private:
  void put(const sim::Engine& engine, const LookedAt& looked, bool parts);
  /// A new reading with room for `numbers`; null: it was told already, or there is no room.
  rave_wire_Reading* begin(const LookedAt& looked, std::uint8_t part, std::uint32_t sequence,
                           std::size_t numbers);
  void put_commands(const sim::Engine& engine, const LookedAt& looked);
  void put_part(const LookedAt& looked, std::uint8_t part, ReadingKind kind,
                const SampleHeader* header, const void* records);

  bus::Writer<bus::Readings> writer_;
  std::uint32_t host_;
  Clock::time_point next_{};
  Clock::time_point again_at_{};
  /// By robot, sensor and part: sequence of the last published sample.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, std::uint32_t> told_;
  std::vector<rave_wire_Reading> readings_;
  std::vector<float> values_;
  std::uint32_t left_out_ = 0;
};

}  // namespace rave::onlook
