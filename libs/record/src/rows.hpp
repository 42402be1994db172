// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/record/run_record.hpp"

namespace rave::record {

/// Passes decoded items to a recorder as rows again: consecutive robots with consecutive bytes. The
/// bytes must be valid until RunRecorder::end_step().
void add_rows(const std::vector<Percept>& percepts, RunRecorder& recorder);
void add_rows(const std::vector<CommandRecord>& commands, RunRecorder& recorder);

}  // namespace rave::record
