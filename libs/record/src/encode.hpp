// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/record/cdr.hpp"
#include "rave/record/run_messages.hpp"

// The inverse of decode.cpp. Each function begins a new message in the writer.
namespace rave::record {

void encode_run(CdrWriter& writer, const RunInfo& info);
void encode_end(CdrWriter& writer, const RunEnd& end);
void encode_event(CdrWriter& writer, SimTime time, std::uint64_t step, const RunEvent& event);
void encode_shadow(CdrWriter& writer, SimTime time, std::uint64_t step, const ShadowRecord& shadow);
void encode_input(CdrWriter& writer, SimTime time, const RunInput& input);
void encode_chat(CdrWriter& writer, SimTime time, const RunChat& chat);
void encode_hash(CdrWriter& writer, const StepHash& hash);
void encode_console(CdrWriter& writer, const ConsoleLine& line);
/// Time, step, version and the count of the array that follows.
void encode_step_head(CdrWriter& writer, SimTime time, std::uint64_t step, std::size_t count);

}  // namespace rave::record
