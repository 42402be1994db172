// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "utias/plugins/playback.hpp"

namespace rave::utias {

/// The report of a stream as one JSON object; the README.md of this driver describes it. All times
/// are seconds from the origin of the data set, clock offset included.
[[nodiscard]] std::string report_json(const Playback& playback);

}  // namespace rave::utias
