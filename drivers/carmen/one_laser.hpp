// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "carmen/log_text.hpp"

namespace rave::carmen {

/// Leaves the scans of one message, so that each scan of the laser is there once: of the messages
/// with poses, if there are any, the most frequent one. Rows of the others are passed over. Of that
/// message it leaves the scans with the most frequent number of ranges, because a sensor has one
/// set of bearings. The others are refused.
void keep_one_laser(ParsedLog& log, const std::string& file);

}  // namespace rave::carmen
