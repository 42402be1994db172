// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/pace/lateness.hpp"
#include "rave/report/picture.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/radio.hpp"

// What is known of a run when it is over, as plain values that can be kept in a file: of all of it
// in one process, of the robots of one host, or of the motion of all. The results are made of these
// alone, so that a run of several processes has those of one.
namespace rave::runtime {

/// The nearest that a pair of bodies of two kinds came.
struct Encounter {
  double gap_m = 0;      ///< Between their outlines; negative if they overlapped.
  double centres_m = 0;  ///< Between their origins.
  double time_s = 0;
  std::uint32_t a = 0;  ///< Body ids; `a` is a robot.
  std::uint32_t b = 0;
};

/// One robot that caught another.
struct Capture {
  RobotId predator;
  RobotId prey;
  double time_s = 0;
  double gap_m = 0;  ///< Between the outlines, when it was noticed.
};

/// How many real sightings the virtual camera confirms.
struct SightingTally {
  std::uint64_t total = 0;    ///< With a code that the world knows.
  std::uint64_t within = 0;   ///< Of these: range and bearing agree.
  std::uint64_t unknown = 0;  ///< With a code that the world does not know.

  [[nodiscard]] double within_pct() const noexcept {
    return total == 0 ? 0 : 100.0 * static_cast<double>(within) / static_cast<double>(total);
  }
  SightingTally& operator+=(const SightingTally& other) noexcept {
    total += other.total;
    within += other.within;
    unknown += other.unknown;
    return *this;
  }
};

/// What the check of the sightings saw.
struct SightingFacts {
  std::map<std::string, SightingTally> by_robot;  ///< By name.
  std::map<std::int32_t, std::uint64_t> unknown_codes;

  [[nodiscard]] SightingTally all() const noexcept {
    SightingTally sum;
    for (const auto& [robot, tally] : by_robot) sum += tally;
    return sum;
  }
};

/// How near a robot came to a place where it was to come.
struct ArrivalFacts {
  bool known = false;  ///< It was known where it was.
  double nearest_m = 0;
  std::optional<double> time_s;  ///< When it was there, if it was.
};

/// What the checks of touches and arrivals saw, in the order of the scenario.
struct GoalFacts {
  /// By entry of `touches`: how often its sensor began to touch; 0 of those that count events.
  std::vector<std::uint64_t> touches;
  /// By entry of `touches`: robots whose sensor never gave a reading, by number.
  std::vector<std::vector<std::uint32_t>> silent;
  std::vector<ArrivalFacts> arrivals;  ///< By entry of `arrivals`, then by robot.
};

/// What the check of captures saw.
struct CaptureFacts {
  std::vector<Capture> captures;
  std::optional<double> closest_m;  ///< The least gap; none: predator and prey were never there.
};

/// One robot at the end of the run.
struct RobotFacts {
  std::uint32_t robot = 0;
  std::string program;
  std::uint64_t commands = 0;
  bool obeys = false;
  bool known = false;  ///< Where it is.
  bool stale = false;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  std::int64_t stamp_ns = 0;
  double way_m = 0;
};

/// What a device, the driver of a real sensor or a transmitter says of itself.
struct InstrumentFacts {
  std::uint32_t robot = 0;
  std::string name;
  std::string driver;
  std::string report;
};

/// The track of one robot.
struct TrackFacts {
  std::uint32_t robot = 0;
  report::PictureTrack track;
};

/// One robot at the frozen instant.
struct InstantRobot {
  std::uint32_t robot = 0;
  std::vector<report::PictureRobot> bodies;
  std::vector<report::PictureHit> hits;
};

/// A sighting of the last moments before the frozen instant.
struct InstantSighting {
  std::uint64_t step = 0;  ///< In which this robot saw this first.
  std::uint32_t robot = 0;
  report::PictureSighting shown;
};

struct InstantFacts {
  double t_s = 0;
  std::vector<InstantRobot> robots;  ///< By robot.
  std::vector<InstantSighting> sightings;
};

/// How far the shadow of a robot was from it, see Shadows.
struct ShadowFacts {
  std::uint32_t robot = 0;
  std::string report;  ///< A JSON object, for result.json.
};

/// What a host saw of all robots, for who knows of the end of the run alone, see WorldAccount.
struct WorldFacts {
  std::uint64_t first_step = 0;  ///< From this step on ...
  std::uint64_t next_step = 0;   ///< ... up to that before this one.
  std::vector<sim::Event> events;
  std::optional<CaptureFacts> capture;  ///< None: there is no such check.
};

struct RunFacts {
  std::uint64_t first_step = 0;  ///< Of one that came later.
  std::uint64_t steps = 0;       ///< The step that would have come next.
  bool has_world = false;        ///< Contacts of all robots are among the events.
  /// From this step on they and captures are known; above 0: to a manager that took the place of
  /// another, in a run of which no host saw all. Of who puts the results together; in no file.
  std::uint64_t world_from = 0;
  std::vector<std::string> problems;
  std::vector<sim::Event> events;  ///< By step; in a step by robot, captures last.
  std::vector<RobotFacts> robots;  ///< By robot; the same of the following three.
  std::vector<InstrumentFacts> devices;
  std::vector<InstrumentFacts> streams;
  std::vector<InstrumentFacts> transmitters;
  sim::RadioCounts radio;
  std::uint64_t inputs_by_hand = 0;
  LatenessFacts lateness;  ///< Of a run with a pace; of several processes the sum.
  std::map<std::string, std::map<std::string, std::uint64_t>> hits;
  std::map<std::string, Encounter> closest;
  std::optional<SightingFacts> sightings;
  GoalFacts goals;
  std::optional<CaptureFacts> capture;
  std::vector<TrackFacts> tracks;  ///< By robot, odometry alone behind all others.
  std::optional<InstantFacts> instant;
  std::vector<ShadowFacts> shadows;  ///< By robot.
  /// Of a host during whose run the manager was replaced.
  std::optional<WorldFacts> world;
};

/// Adds what another process knows of the same run. In any order the same comes of it, if no robot
/// is in two of them; of one that is, the latter counts.
void merge(RunFacts from, RunFacts& into);

}  // namespace rave::runtime
