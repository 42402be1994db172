// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record_file.hpp"

namespace rave::record {

/// Verifies every checksum of a file and counts its messages. Memory: the largest chunk.
[[nodiscard]] CheckedFile check_file(const RecordFile& file);

}  // namespace rave::record
