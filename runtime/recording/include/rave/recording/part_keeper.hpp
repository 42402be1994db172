// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Puts the real and the virtual part of every reading of hybrid sensors into the record, beside
/// the result that the program got. Of several readings in one step those of the newest, as with
/// results. Looks at hybrid sensors only, so other runs pay nothing.
class PartKeeper {
 public:
  explicit PartKeeper(const sim::EngineSpec& spec);

  /// Which sensors are hybrids and of what, by `robot/sensor` (metadata `rave.hybrid`).
  /// `all`: of robots that run elsewhere, too.
  [[nodiscard]] static record::StringMap describe(const sim::EngineSpec& spec, bool all = false);
  /// A robot has its other set of drivers: `spec` is that of the engine from now on. Readings of a
  /// sensor go on counting, so what was kept is not kept again.
  void follow(const sim::EngineSpec& spec);
  /// After a step of the engine, between begin_step() and end_step() of the recorder.
  void keep(const sim::Engine& engine, record::RunRecorder& recorder);

 private:
  struct Hybrid {
    RobotId robot;
    std::uint32_t sensor = 0;
    ReadingKind kind = ReadingKind::kNone;
    std::uint32_t seen = 0;  ///< Sequence of the last reading that was kept.
  };
  std::vector<Hybrid> hybrids_;
};

}  // namespace rave::runtime
