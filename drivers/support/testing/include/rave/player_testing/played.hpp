// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/player_testing/player.hpp"
#include "rave/player_testing/recording_sink.hpp"

namespace rave::recording {

/// Opens, waits for the end of the recording and closes.
template <class Record>
std::vector<Published<Record>> play_once(Player& player) {
  RecordingSink<Record> sink;
  EXPECT_EQ(player.open(sink), "");
  sink.await_end();
  sink.close();
  player.close();
  EXPECT_EQ(sink.fault(), "");
  return sink.published();
}

/// All that a player gives in a stepped run of a robot whose file lies in `folder`.
template <class Record>
std::vector<Published<Record>> play_all(const std::string& driver, const Given& given,
                                        const std::string& folder) {
  Player player(driver);
  const std::string error = player.configure(given, folder);
  EXPECT_EQ(error, "");
  if (!error.empty()) return {};
  return play_once<Record>(player);
}

}  // namespace rave::recording
