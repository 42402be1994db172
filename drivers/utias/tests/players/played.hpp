// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "../recorded.hpp"
#include "rave/player_testing/played.hpp"

namespace rave::utias {

using recording::Given;
using recording::kForever_ns;
using recording::Player;
using recording::Published;
using recording::RecordingSink;

inline std::string data_folder() { return RAVE_SOURCE_DIR "/data/utias-mrclam6"; }

/// All that a player gives in a stepped run from a folder below data/utias-mrclam6.
template <class Record>
std::vector<Published<Record>> play_all(const std::string& driver, const Given& given) {
  return recording::play_all<Record>(driver, given, data_folder());
}

}  // namespace rave::utias
