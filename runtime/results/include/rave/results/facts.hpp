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

// The facts of a run after its end, as plain values that can be stored in a file: of the whole run
// in one process, of the robots of one host, or of the motion of all. Results are computed from
// facts only, so a run of several processes has the same results as one of a single process.
namespace rave::runtime {

/// The closest approach of two bodies.
struct Encounter {
  double gap_m = 0;      ///< Distance between their outlines; negative if they overlapped.
  double centres_m = 0;  ///< Distance between their origins.
  double time_s = 0;
  std::uint32_t a = 0;  ///< Body ids; `a` is a robot.
  std::uint32_t b = 0;
};

/// A capture.
struct Capture {
  RobotId predator;
  RobotId prey;
  double time_s = 0;
  double gap_m = 0;  ///< Distance between the outlines when it was detected.
};

/// Counts of real sightings compared with the virtual camera.
struct SightingTally {
  std::uint64_t total = 0;    ///< Sightings with a known code.
  std::uint64_t within = 0;   ///< Those whose range and bearing agree.
  std::uint64_t unknown = 0;  ///< Sightings with an unknown code.

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

/// The result of the sightings check.
struct SightingFacts {
  std::map<std::string, SightingTally> by_robot;  ///< By name of the robot.
  std::map<std::int32_t, std::uint64_t> unknown_codes;

  [[nodiscard]] SightingTally all() const noexcept {
    SightingTally sum;
    for (const auto& [robot, tally] : by_robot) sum += tally;
    return sum;
  }
};

/// The closest approach of a robot to its goal in an arrivals check.
struct ArrivalFacts {
  bool known = false;  ///< Whether its pose was ever known.
  double nearest_m = 0;
  std::optional<double> time_s;  ///< Time of its arrival; empty: it did not arrive.
};

/// The data of the checks of touches and arrivals, in the order of the scenario.
struct GoalFacts {
  /// By entry of `touches`: number of contacts that its sensor reported; 0 for entries that count
  /// events.
  std::vector<std::uint64_t> touches;
  /// By entry of `touches`: ids of the robots whose sensor never gave a reading.
  std::vector<std::vector<std::uint32_t>> silent;
  std::vector<ArrivalFacts> arrivals;  ///< By entry of `arrivals`, then by robot.
};

/// The data of the capture check.
struct CaptureFacts {
  std::vector<Capture> captures;
  std::optional<double> closest_m;  ///< Least distance of the outlines; empty: predator and prey
                                    ///< were never both present.
};

/// One robot at the end of the run.
struct RobotFacts {
  std::uint32_t robot = 0;
  std::string program;
  std::uint64_t commands = 0;
  bool obeys = false;
  bool known = false;  ///< Whether its pose is known.
  bool stale = false;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  std::int64_t stamp_ns = 0;
  double way_m = 0;
};

/// The report() of a device, a real sensor or a transmitter.
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

/// One robot at the time of the picture.
struct InstantRobot {
  std::uint32_t robot = 0;
  std::vector<report::PictureRobot> bodies;
  std::vector<report::PictureHit> hits;
};

/// A sighting shortly before the time of the picture.
struct InstantSighting {
  std::uint64_t step = 0;  ///< The step of this sighting.
  std::uint32_t robot = 0;
  report::PictureSighting shown;
};

/// A tile of the map that the program of a robot kept, as maps::MapTile has it.
struct MapFacts {
  std::uint32_t robot = 0;
  double resolution_m = 0;
  Vec2 origin_W;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  std::int64_t stamp_ns = 0;
  std::vector<std::uint8_t> cells;
};

struct InstantFacts {
  double t_s = 0;
  std::vector<InstantRobot> robots;  ///< By robot.
  std::vector<InstantSighting> sightings;
};

/// The difference between a robot and its shadow, see Shadows.
struct ShadowFacts {
  std::uint32_t robot = 0;
  std::string report;  ///< A JSON object, for result.json.
};

/// What a host received about all robots; used if the manager has not seen the whole run, see
/// WorldAccount.
struct WorldFacts {
  std::uint64_t first_step = 0;  ///< The first step that it covers.
  std::uint64_t next_step = 0;   ///< The step after the last one that it covers.
  std::vector<sim::Event> events;
  std::optional<CaptureFacts> capture;  ///< Empty: the scenario has no such check.
};

/// In real time with several hosts: how long poses took until another host had them in a step.
struct PoseDelayFacts {
  std::uint64_t count = 0;
  std::int64_t slowest_ns = 0;
  std::int64_t sum_ns = 0;
};

struct RunFacts {
  std::uint64_t first_step = 0;  ///< Above 0 for a host that joined late.
  std::uint64_t steps = 0;       ///< The number of the next step.
  bool has_world = false;        ///< Whether the events include the contacts of all robots.
  /// The first step with known contacts and captures. Above 0 if the manager was replaced during
  /// the run and no host has seen all of it. Set by the process that computes the results; not
  /// stored in a file.
  std::uint64_t world_from = 0;
  std::vector<std::string> problems;
  std::vector<sim::Event> events;  ///< By step, then by robot; captures last in their step.
  std::vector<RobotFacts> robots;  ///< By robot, like the following three.
  std::vector<InstrumentFacts> devices;
  std::vector<InstrumentFacts> streams;
  std::vector<InstrumentFacts> transmitters;
  sim::RadioCounts radio;
  std::uint64_t inputs_by_hand = 0;
  LatenessFacts lateness;  ///< For a run with a pace; with several processes the sum.
  PoseDelayFacts poses;
  std::map<std::string, std::map<std::string, std::uint64_t>> hits;
  std::map<std::string, Encounter> closest;
  std::optional<SightingFacts> sightings;
  GoalFacts goals;
  std::optional<CaptureFacts> capture;
  std::vector<TrackFacts> tracks;  ///< By robot; tracks from odometry alone come last.
  std::optional<InstantFacts> instant;
  std::vector<ShadowFacts> shadows;  ///< By robot.
  std::vector<MapFacts> maps;        ///< By robot.
  /// Set by a host during whose run the manager was replaced.
  std::optional<WorldFacts> world;
};

/// Adds the facts of another process of the same run. The order of merging does not matter, unless
/// a robot is in two of them; then the later one counts.
void merge(RunFacts from, RunFacts& into);

}  // namespace rave::runtime
