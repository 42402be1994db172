// SPDX-License-Identifier: Apache-2.0
#include "rave/results/facts_file.hpp"

#include <algorithm>
#include <cmath>

#include "rave/maps/map_tile.hpp"
#include "rave/record/cdr_archive.hpp"
#include "rave/sim/guard.hpp"

namespace rave::runtime {
namespace {

constexpr const char* kMark = "rave findings";
constexpr std::uint32_t kVersion = 5;

/// The list of members and their order. A change of it needs another kVersion.
template <class Archive>
struct Members {
  Archive& archive;

  void of(Vec2& v) { archive(v.x, v.y); }
  void of(Pose2& v) { archive(v.x, v.y, v.yaw); }
  void of(sim::Event& v) { archive(v.step, v.robot, v.kind, v.other, v.text, v.detail); }
  void of(sim::RadioCounts& v) {
    archive(v.offered, v.refused, v.sent, v.lost_queue, v.lost_device, v.addressed, v.delivered,
            v.lost_range, v.lost_obstacle, v.lost_chance, v.lost_mailbox, v.heard, v.foreign,
            v.repeated, v.garbled, v.overrun);
  }
  void of(report::TrackPoint& v) { archive(v.t_s, v.X_WB); }
  void of(report::PoseGap& v) { archive(v.t0_s, v.t1_s); }
  void of(report::PictureTrack& v) {
    archive(v.label, v.kind, v.colour, v.points, v.gaps, v.odometry_only, v.pose_lost_t_s);
  }
  void of(report::PictureRobot& v) { archive(v.outline_W, v.X_WB, v.kind, v.label, v.colour); }
  void of(report::PictureHit& v) { archive(v.from_W, v.to_W, v.kind); }
  void of(report::PictureSighting& v) { archive(v.from_W, v.to_W, v.tube_W, v.label, v.colour); }
  void of(Encounter& v) { archive(v.gap_m, v.centres_m, v.time_s, v.a, v.b); }
  void of(Capture& v) { archive(v.predator, v.prey, v.time_s, v.gap_m); }
  void of(SightingTally& v) { archive(v.total, v.within, v.unknown); }
  void of(SightingFacts& v) { archive(v.by_robot, v.unknown_codes); }
  void of(ArrivalFacts& v) { archive(v.known, v.nearest_m, v.time_s); }
  void of(GoalFacts& v) { archive(v.touches, v.silent, v.arrivals); }
  void of(CaptureFacts& v) { archive(v.captures, v.closest_m); }
  void of(LatenessFacts& v) { archive(v.deadlines, v.missed, v.worst_ns, v.stops, v.blame); }
  void of(PoseDelayFacts& v) { archive(v.count, v.slowest_ns, v.sum_ns); }
  void of(RobotFacts& v) {
    archive(v.robot, v.program, v.commands, v.obeys, v.known, v.stale, v.x_m, v.y_m, v.yaw_rad,
            v.stamp_ns, v.way_m);
  }
  void of(InstrumentFacts& v) { archive(v.robot, v.name, v.driver, v.report); }
  void of(TrackFacts& v) { archive(v.robot, v.track); }
  void of(InstantRobot& v) { archive(v.robot, v.bodies, v.hits); }
  void of(InstantSighting& v) { archive(v.step, v.robot, v.shown); }
  void of(InstantFacts& v) { archive(v.t_s, v.robots, v.sightings); }
  void of(MapFacts& v) {
    archive(v.robot, v.resolution_m, v.origin_W, v.columns, v.rows, v.column, v.row, v.stamp_ns,
            v.cells);
  }
  void of(ShadowFacts& v) { archive(v.robot, v.report); }
  void of(WorldFacts& v) { archive(v.first_step, v.next_step, v.events, v.capture); }
  void of(RunFacts& v) {
    archive(v.first_step, v.steps, v.has_world, v.problems, v.events, v.robots, v.devices,
            v.streams, v.transmitters, v.radio, v.inputs_by_hand, v.lateness, v.poses, v.hits,
            v.closest, v.sightings, v.goals, v.capture, v.tracks, v.instant, v.shadows, v.maps,
            v.world);
  }
};

/// Enumerators are stored as numbers; they are checked before use, because a number may be outside
/// of its type.
bool is_kind(report::Kind kind) {
  return std::ranges::find(report::kAllKinds, kind) != report::kAllKinds.end();
}

// The bytes may come from another process. Indices are used later to look up names, so each one is
// checked against the scenario.
bool fits(const sim::Event& event, const FactsLimits& limits) {
  const bool of_guard =
      event.kind == sim::EventKind::kGuardSlowed || event.kind == sim::EventKind::kGuardStopped;
  const bool of_nobody = event.kind == sim::EventKind::kChangeRefused ||
                         event.kind == sim::EventKind::kObstacleAdded ||
                         event.kind == sim::EventKind::kObstacleMoved ||
                         event.kind == sim::EventKind::kObstacleRemoved;
  const bool whom = event.robot.valid() ? event.robot.value() < limits.robots : of_nobody;
  return whom && to_string(event.kind) != "unknown" &&
         (!event.other.valid() || event.other.value() < limits.bodies) &&
         (!of_guard || event.detail < sim::kGuardLimits);
}

template <class T>
bool robots_fit(const std::vector<T>& items, const FactsLimits& limits) {
  // Sorted as well, because merging searches these lists by bisection.
  return std::ranges::all_of(items, [&](const T& item) { return item.robot < limits.robots; }) &&
         std::ranges::is_sorted(items, {}, &T::robot);
}

bool fits(const CaptureFacts& facts, const FactsLimits& limits) {
  return std::ranges::all_of(facts.captures, [&](const Capture& capture) {
    return capture.predator.value() < limits.robots && capture.prey.value() < limits.robots;
  });
}

bool fits(const InstantFacts& facts, const FactsLimits& limits) {
  const auto hit_fits = [](const report::PictureHit& hit) {
    return !hit.kind || is_kind(*hit.kind);
  };
  return robots_fit(facts.robots, limits) &&
         std::ranges::all_of(facts.robots, [&](const InstantRobot& robot) {
           return std::ranges::all_of(robot.bodies, is_kind, &report::PictureRobot::kind) &&
                  std::ranges::all_of(robot.hits, hit_fits);
         });
}

bool fits(const LatenessFacts& facts) {
  return facts.missed <= facts.deadlines && facts.worst_ns >= 0 &&
         std::ranges::all_of(facts.blame, [](const auto& one) { return is_late_phase(one.first); });
}

bool fits(const PoseDelayFacts& facts) {
  // A bound of an hour keeps sums of many hosts from overflowing.
  constexpr std::int64_t kMost_ns = 3'600'000'000'000;
  constexpr std::uint64_t kMostPoses = 1'000'000'000'000;
  return facts.count <= kMostPoses && facts.slowest_ns >= 0 && facts.slowest_ns <= kMost_ns &&
         facts.sum_ns >= facts.slowest_ns && facts.sum_ns <= INT64_MAX / 1024;
}

bool fits(const WorldFacts& facts, const FactsLimits& limits) {
  return std::ranges::all_of(facts.events,
                             [&](const sim::Event& event) { return fits(event, limits); }) &&
         (!facts.capture || fits(*facts.capture, limits));
}

bool fits(const MapFacts& facts) {
  constexpr double kFar_m = 1e7;
  const bool place = std::abs(facts.origin_W.x) < kFar_m && std::abs(facts.origin_W.y) < kFar_m;
  return facts.resolution_m >= 1e-3 && facts.resolution_m <= 1e3 && place &&
         facts.columns <= 65'536 && facts.rows <= 65'536 &&
         maps::MapFrame::side(facts.columns, facts.column) == maps::kTileCells &&
         maps::MapFrame::side(facts.rows, facts.row) == maps::kTileCells &&
         facts.cells.size() == std::size_t{maps::kTileCells} * maps::kTileCells &&
         std::ranges::all_of(
             facts.cells, [](std::uint8_t cell) { return cell <= 100 || cell == maps::kUnknown; });
}

bool fits(const RunFacts& facts, const FactsLimits& limits) {
  const auto encounter_fits = [&](const auto& entry) {
    return entry.second.a < limits.bodies && entry.second.b < limits.bodies;
  };
  return robots_fit(facts.robots, limits) && robots_fit(facts.devices, limits) &&
         robots_fit(facts.streams, limits) && robots_fit(facts.transmitters, limits) &&
         robots_fit(facts.shadows, limits) &&
         std::ranges::all_of(facts.events,
                             [&](const auto& event) { return fits(event, limits); }) &&
         std::ranges::all_of(facts.closest, encounter_fits) &&
         std::ranges::all_of(facts.tracks,
                             [&](const TrackFacts& track) {
                               return track.robot < limits.robots && is_kind(track.track.kind);
                             }) &&
         robots_fit(facts.maps, limits) &&
         std::ranges::all_of(facts.maps, [](const MapFacts& map) { return fits(map); }) &&
         fits(facts.lateness) && fits(facts.poses) &&
         (!facts.capture || fits(*facts.capture, limits)) &&
         (!facts.instant || fits(*facts.instant, limits));
}

}  // namespace

std::vector<std::byte> encode_facts(const FactsOf& about, const RunFacts& facts) {
  record::CdrWriter writer;
  record::CdrPut<Members>{writer}(std::string(kMark), kVersion, about.run_number, about.host,
                                  facts);
  return {writer.bytes().begin(), writer.bytes().end()};
}

Result<RunFacts> decode_facts(std::span<const std::byte> bytes, const FactsOf& about,
                              const FactsLimits& limits) {
  record::CdrReader reader(bytes);
  record::CdrTake<Members> take(reader);
  std::string mark;
  std::uint32_t version = 0;
  FactsOf whose;
  take(mark, version, whose.run_number, whose.host);
  if (!reader.ok() || mark != kMark) {
    return fail(ErrorCode::kParse, "not the results file of a host");
  }
  if (version != kVersion) {
    return fail(ErrorCode::kParse,
                "the results have layout {}; this RAVE reads layout {}, so another version of RAVE "
                "wrote them",
                version, kVersion);
  }
  // A folder may have results of an earlier run with the same name.
  if (whose.run_number != about.run_number) {
    return fail(ErrorCode::kState, "the results belong to another scenario or seed");
  }
  if (whose.host != about.host) {
    return fail(ErrorCode::kState, "the results are of host `{}`, not of `{}`", whose.host,
                about.host);
  }
  RunFacts facts;
  take(facts);
  if (!reader.ok()) return fail(ErrorCode::kParse, "the results are damaged or incomplete");
  if (!fits(facts, limits)) {
    return fail(ErrorCode::kParse, "the results name robots or bodies that do not exist");
  }
  // Invalid facts on the world may be the fault of another process and do not invalidate those on
  // the own robots.
  if (facts.world && !fits(*facts.world, limits)) {
    facts.world.reset();
    facts.problems.emplace_back("its world names robots or bodies that do not exist");
  }
  return facts;
}

}  // namespace rave::runtime
