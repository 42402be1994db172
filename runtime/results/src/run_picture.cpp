// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "rave/results/instant.hpp"
#include "rave/results/outcome.hpp"
#include "rave/results/sighting_check.hpp"

namespace rave::runtime {
namespace {

std::vector<report::PictureTrack> tracks_of(const RunFacts& facts) {
  std::vector<report::PictureTrack> tracks;
  for (const TrackFacts& track : facts.tracks) tracks.push_back(track.track);
  return tracks;
}

report::PictureInstant shown(const InstantFacts& facts) {
  report::PictureInstant instant;
  instant.t_s = facts.t_s;
  for (const InstantRobot& robot : facts.robots) {
    instant.robots.insert(instant.robots.end(), robot.bodies.begin(), robot.bodies.end());
    instant.hits.insert(instant.hits.end(), robot.hits.begin(), robot.hits.end());
  }
  for (const InstantSighting& sighting : facts.sightings) {
    instant.sightings.push_back(sighting.shown);
  }
  return instant;
}

/// Few simulated robots get the colours of real ones where there are none: grey lines that cross
/// cannot be distinguished.
void colour_few(report::Picture& picture) {
  constexpr std::size_t kColours = 5;
  if (picture.tracks.empty() || picture.tracks.size() > kColours) return;
  const bool all_grey = std::ranges::all_of(picture.tracks, [](const report::PictureTrack& track) {
    return track.kind == report::Kind::kSimulatedRobot && track.colour.empty();
  });
  if (!all_grey || picture.tracks.size() < 2) return;
  for (std::size_t i = 0; i < picture.tracks.size(); ++i) {
    report::PictureTrack& track = picture.tracks[i];
    track.colour = report::robot_colour(i);
    if (!picture.instant) continue;
    bool is_its_own = false;
    for (report::PictureRobot& body : picture.instant->robots) {
      // Only the first body of a robot has its name.
      if (!body.label.empty()) is_its_own = body.label == track.label;
      if (is_its_own) body.colour = track.colour;
    }
  }
}

}  // namespace

report::Picture make_picture(const RunResults& results, const RunOutcome& outcome) {
  report::Picture picture;
  const config::ScenarioFile& scenario = results.scenario.scenario;
  picture.title = scenario.picture && !scenario.picture->title.empty() ? scenario.picture->title
                                                                       : scenario.name.value;
  const std::size_t count = results.spec.robots.size();
  const std::size_t real = results.real_robots();
  picture.subtitle = fmt::format("{} real and {} simulated robots in one world, {:.0f} s", real,
                                 count - real, results.done_s());
  if (scenario.checks.sightings && results.facts.sightings) {
    const SightingTally tally = results.facts.sightings->all();
    picture.caption.push_back(
        fmt::format("{:.2f} % of {} real camera sightings agree with the virtual camera within "
                    "{} m and {}\u00b0.",
                    tally.within_pct(), tally.total, scenario.checks.sightings->range_m,
                    scenario.checks.sightings->bearing_deg));
  }
  if (!outcome.hash.empty()) picture.caption.push_back("Run hash " + outcome.hash);
  const world::WorldModel& world = results.spec.world;
  for (std::size_t number = 0; number < world.obstacle_count(); ++number) {
    const std::uint32_t body = world.obstacle_id(number);
    const world::Obstacle& obstacle = *world.obstacle(body);
    // The picture shows the world at the end.
    if (obstacle.removed) continue;
    for (std::size_t i = 0; i < obstacle.body.shapes.size(); ++i) {
      report::PictureBody shown;
      shown.outline_W = outline_of(obstacle.body.shapes[i], obstacle.X_WB);
      shown.kind = results.kinds.kind(body);
      // Landmarks are labelled with their number; the walls of a map are too numerous to be
      // labelled.
      if (i == 0 && shown.kind == report::Kind::kLandmark) {
        const std::size_t dash = obstacle.body.name.rfind('-');
        shown.label =
            dash == std::string::npos ? obstacle.body.name : obstacle.body.name.substr(dash + 1);
      } else if (i == 0 && shown.kind == report::Kind::kVirtualObstacle) {
        shown.label = obstacle.body.name;
      }
      shown.colour = obstacle.body.colour;
      picture.bodies.push_back(std::move(shown));
    }
  }
  picture.tracks = tracks_of(results.facts);
  if (results.facts.instant) picture.instant = shown(*results.facts.instant);
  colour_few(picture);
  return picture;
}

}  // namespace rave::runtime
