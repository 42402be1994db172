// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "utias/plugins/playback.hpp"

namespace rave::utias {

/// The report of a stream as one JSON object, described in README.md of this driver. All times are
/// seconds from the origin of the data set, the offset of the clock included.
[[nodiscard]] std::string report_json(const Playback& playback);

}  // namespace rave::utias
