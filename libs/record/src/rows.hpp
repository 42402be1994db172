// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/record/run_record.hpp"

namespace rave::record {

/// Gives decoded items to a recorder as the rows that they were: robots that follow each other,
/// whose bytes do so, too. The bytes must stay until RunRecorder::end_step().
void add_rows(const std::vector<Percept>& percepts, RunRecorder& recorder);
void add_rows(const std::vector<CommandRecord>& commands, RunRecorder& recorder);

}  // namespace rave::record
