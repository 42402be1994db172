// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/request/request.hpp"

namespace rave::runtime {

/// The run hash after each step; empty for recordings without hashes.
[[nodiscard]] Result<std::vector<std::uint64_t>> read_hashes(const record::McapReader& reader);

/// The requests made by hand in the recorded run, in their order.
[[nodiscard]] Result<std::vector<record::RunInput>> read_inputs(const record::McapReader& reader);

/// Converts a recorded request. Error kParse.
[[nodiscard]] Result<request::Request> request_of(const record::RunInput& input);

}  // namespace rave::runtime
