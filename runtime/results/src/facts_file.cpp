// SPDX-License-Identifier: Apache-2.0
#include "rave/results/facts_file.hpp"

#include <algorithm>
#include <concepts>

#include "rave/record/cdr.hpp"
#include "rave/sim/guard.hpp"

namespace rave::runtime {
namespace {

constexpr const char* kMark = "rave findings";
constexpr std::uint32_t kVersion = 3;

/// The list of members and their order, used for reading and writing: each member is passed to
/// `archive`.
/// One list serves reading and writing, so the two cannot disagree. A change of it needs another
/// kVersion.
template <class Archive>
struct Members {
  Archive& archive;

  void of(Vec2& v) { archive(v.x, v.y); }
  void of(Pose2& v) { archive(v.x, v.y, v.yaw); }
  void of(RobotId& v) { archive.id(v); }
  void of(BodyId& v) { archive.id(v); }
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
  void of(RobotFacts& v) {
    archive(v.robot, v.program, v.commands, v.obeys, v.known, v.stale, v.x_m, v.y_m, v.yaw_rad,
            v.stamp_ns, v.way_m);
  }
  void of(InstrumentFacts& v) { archive(v.robot, v.name, v.driver, v.report); }
  void of(TrackFacts& v) { archive(v.robot, v.track); }
  void of(InstantRobot& v) { archive(v.robot, v.bodies, v.hits); }
  void of(InstantSighting& v) { archive(v.step, v.robot, v.shown); }
  void of(InstantFacts& v) { archive(v.t_s, v.robots, v.sightings); }
  void of(ShadowFacts& v) { archive(v.robot, v.report); }
  void of(WorldFacts& v) { archive(v.first_step, v.next_step, v.events, v.capture); }
  void of(RunFacts& v) {
    archive(v.first_step, v.steps, v.has_world, v.problems, v.events, v.robots, v.devices,
            v.streams, v.transmitters, v.radio, v.inputs_by_hand, v.lateness, v.hits, v.closest,
            v.sightings, v.goals, v.capture, v.tracks, v.instant, v.shadows, v.world);
  }
};

template <class T>
concept Plain = std::integral<T> || std::floating_point<T>;

class Writer {
 public:
  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }
  template <class Id>
  void id(Id& value) {
    cdr_.put(value.value());
  }
  [[nodiscard]] std::vector<std::byte> bytes() const {
    return {cdr_.bytes().begin(), cdr_.bytes().end()};
  }

 private:
  template <class T>
  void put(T& value) {
    if constexpr (std::same_as<T, bool>) {
      cdr_.put(static_cast<std::uint8_t>(value ? 1 : 0));
    } else if constexpr (Plain<T>) {
      cdr_.put(value);
    } else if constexpr (std::is_enum_v<T>) {
      cdr_.put(static_cast<std::uint32_t>(value));
    } else {
      Members<Writer>{*this}.of(value);
    }
  }
  void put(std::string& value) { cdr_.put_string(value); }
  template <class T>
  void put(std::optional<T>& value) {
    cdr_.put(static_cast<std::uint8_t>(value ? 1 : 0));
    if (value) put(*value);
  }
  template <class T>
  void put(std::vector<T>& values) {
    cdr_.put_count(values.size());
    for (T& value : values) put(value);
  }
  template <class Key, class T>
  void put(std::map<Key, T>& values) {
    cdr_.put_count(values.size());
    for (auto& [key, value] : values) {
      // Keys of a map are constant, and put() takes the same references as the reader.
      Key copy = key;
      put(copy);
      put(value);
    }
  }

  record::CdrWriter cdr_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : cdr_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  template <class Id>
  void id(Id& value) {
    value = Id(cdr_.get<std::uint32_t>());
  }
  [[nodiscard]] bool ok() const { return cdr_.ok(); }

 private:
  template <class T>
  void take(T& value) {
    if constexpr (std::same_as<T, bool>) {
      value = cdr_.get<std::uint8_t>() != 0;
    } else if constexpr (Plain<T>) {
      value = cdr_.get<T>();
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(cdr_.get<std::uint32_t>());
    } else {
      Members<Reader>{*this}.of(value);
    }
  }
  void take(std::string& value) { value = cdr_.get_string(); }
  template <class T>
  void take(std::optional<T>& value) {
    value.reset();
    if (cdr_.get<std::uint8_t>() != 0) take(value.emplace());
  }
  /// A count is accepted only if enough bytes follow.
  template <class T>
  void take(std::vector<T>& values) {
    values.clear();
    const std::uint32_t count = cdr_.get_count(1);
    for (std::uint32_t i = 0; i < count && cdr_.ok(); ++i) take(values.emplace_back());
  }
  template <class Key, class T>
  void take(std::map<Key, T>& values) {
    values.clear();
    const std::uint32_t count = cdr_.get_count(1);
    for (std::uint32_t i = 0; i < count && cdr_.ok(); ++i) {
      Key key{};
      take(key);
      take(values[key]);
    }
  }

  record::CdrReader cdr_;
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

bool fits(const WorldFacts& facts, const FactsLimits& limits) {
  return std::ranges::all_of(facts.events,
                             [&](const sim::Event& event) { return fits(event, limits); }) &&
         (!facts.capture || fits(*facts.capture, limits));
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
         fits(facts.lateness) && (!facts.capture || fits(*facts.capture, limits)) &&
         (!facts.instant || fits(*facts.instant, limits));
}

}  // namespace

std::vector<std::byte> encode_facts(const FactsOf& about, const RunFacts& facts) {
  Writer writer;
  std::string mark = kMark;
  std::uint32_t version = kVersion;
  // Writing changes nothing; the copy is needed because the same list of members serves reading.
  FactsOf whose = about;
  RunFacts copy = facts;
  writer(mark, version, whose.run_number, whose.host, copy);
  return writer.bytes();
}

Result<RunFacts> decode_facts(std::span<const std::byte> bytes, const FactsOf& about,
                              const FactsLimits& limits) {
  Reader reader(bytes);
  std::string mark;
  std::uint32_t version = 0;
  FactsOf whose;
  reader(mark, version, whose.run_number, whose.host);
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
  reader(facts);
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
