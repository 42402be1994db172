// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/build.hpp"
#include "rave/record/run_info.hpp"
#include "rave/record/run_record.hpp"

namespace rave::runtime {

/// The description of a run, available before its devices are opened.
struct DescribedRun {
  record::RunInfo info;       ///< All robots and sensors; ranges that only open devices know are 0.
  record::StringMap hybrids;  ///< See RunView.
};

[[nodiscard]] DescribedRun describe_run(const BuiltScenario& built);

}  // namespace rave::runtime
