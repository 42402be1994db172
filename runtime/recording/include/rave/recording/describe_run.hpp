// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/build.hpp"
#include "rave/record/run_info.hpp"
#include "rave/record/run_record.hpp"

namespace rave::runtime {

/// What is known of a run before anything of it is opened.
struct DescribedRun {
  record::RunInfo info;  ///< All robots and sensors; what only open devices know, ranges, is 0.
  record::StringMap hybrids;  ///< As of RunView.
};

[[nodiscard]] DescribedRun describe_run(const BuiltScenario& built);

}  // namespace rave::runtime
