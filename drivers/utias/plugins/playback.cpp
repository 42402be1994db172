// SPDX-License-Identifier: Apache-2.0
#include "utias/plugins/playback.hpp"

#include <utility>

#include "rave/base/named_path.hpp"

namespace rave::utias {
const StreamReport& Playback::report() const noexcept {
  if (kind == StreamKind::kPoses) return robot().pose_report;
  if (kind == StreamKind::kOdometry) return robot().odometry_report;
  return robot().sighting_report;
}

Result<Playback> load_playback(const HardwareSetup& setup, StreamKind kind,
                               CodeMeaning code_meaning) {
  const Params params = setup.parameters();
  Playback playback;
  playback.folder = params.text("folder");
  const recording::PlayOptions play = recording::play_options(params);
  playback.clock_offset_s = play.clock_offset_s;
  playback.live = play.live;
  playback.kind = kind;

  LoadOptions options;
  options.robots = {static_cast<int>(params.integer("robot"))};
  options.streams = {kind == StreamKind::kPoses, kind == StreamKind::kOdometry,
                     kind == StreamKind::kSightings};
  options.start_s = play.start_s;
  options.end_s = play.end_s;
  options.clock_offset_s = playback.clock_offset_s;
  // One offset for the whole robot, as if its only clock were off.
  options.state_clock_offset_s = playback.clock_offset_s;
  options.code_meaning = code_meaning;
  options.accept_cut = play.accept_cut;
  RAVE_TRY_ASSIGN(playback.data, load(named_path(setup.folder, playback.folder), options));
  return playback;
}

}  // namespace rave::utias
