// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Records how sure robots are of where they are: all that are not, ten times a second of the run
/// at most, and only what changed, but once a second all the same. A reader so finds what holds at
/// a moment in the second before it. Used by one thread.
class VarianceKeeper {
 public:
  /// `told_truth`: by robot, whether its reported pose is the true one, which has no variance.
  void keep(const sim::Engine& engine, const std::vector<std::uint8_t>& told_truth,
            record::RunRecorder& recorder);

 private:
  std::vector<record::PoseVariance> told_;
  std::vector<record::PoseVariance> now_;  ///< Kept for its memory.
  std::int64_t due_ns_ = 0;
  std::int64_t told_ns_ = 0;
};

}  // namespace rave::runtime
