// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cdr_time.hpp"
#include "run_members.hpp"

namespace rave::record {

/// Begins a new message in the writer: a time, then these values in the layouts of RunMembers. The
/// inverse of decode.cpp.
template <class... T>
void encode(CdrWriter& writer, SimTime time, const T&... values) {
  writer.clear();
  put_time(writer, time);
  CdrPut<RunMembers>{writer}(values...);
}

/// Time, step, version and the count of the array that follows. A change of a layout with such an
/// array needs another kLayoutVersion, which also aligns the array to 8 bytes.
inline void encode_step_head(CdrWriter& writer, SimTime time, std::uint64_t step,
                             std::size_t count) {
  encode(writer, time, step, kLayoutVersion, static_cast<std::uint32_t>(count));
}

}  // namespace rave::record
