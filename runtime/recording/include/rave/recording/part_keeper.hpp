// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>

#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Records the real and the virtual half of every reading of hybrid sensors, in addition to the
/// fused result. Of several readings in one step it records the newest, like for results. No cost
/// for runs without hybrid sensors.
class PartKeeper {
 public:
  explicit PartKeeper(const sim::EngineSpec& spec) { follow(spec); }

  /// The hybrid sensors, `robot/sensor` to a description of the parts (metadata `rave.hybrid`).
  /// `all`: include robots that run elsewhere.
  [[nodiscard]] static record::StringMap describe(const sim::EngineSpec& spec, bool all = false);
  /// Call it after a hand-over with the engine's spec. Sequence numbers of a sensor continue, so
  /// nothing is recorded twice.
  void follow(const sim::EngineSpec& spec);
  /// Call it after a step, between begin_step() and end_step() of the recorder.
  void keep(const sim::Engine& engine, record::RunRecorder& recorder);

 private:
  struct Hybrid {
    ReadingKind kind = ReadingKind::kNone;
    std::uint32_t seen = 0;  ///< Sequence of the last recorded reading.
  };
  /// By robot and sensor; also those that are not hybrid at present.
  std::map<std::pair<RobotId, std::uint32_t>, Hybrid> hybrids_;
};

}  // namespace rave::runtime
