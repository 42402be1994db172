// SPDX-License-Identifier: Apache-2.0
#include "rave/shadow/shadows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "rave/assemble/twins.hpp"
#include "rave/base/names.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::runtime {
namespace {

using Json = nlohmann::ordered_json;

/// When there are more moments than this, every second one is deleted.
constexpr std::size_t kMostMoments = 600;

double distance_m(const Pose2& a, const Pose2& b) {
  return std::sqrt(squared_norm(a.position() - b.position()));
}

// Micrometres: more digits would be noise of the last bits.
double rounded(double value) { return std::round(value * 1e6) / 1e6; }

/// A difference that was not measured is null and not 0.
Json number_of(std::uint64_t compared, double value) {
  return compared > 0 ? Json(rounded(value)) : Json();
}

template <class Reading>
Reading first_record(const sim::SensorSample& sample) {
  Reading reading;
  std::memcpy(&reading, sample.records, sizeof reading);
  return reading;
}

Pose2 odometry_of(const sim::SensorSample& sample) {
  const auto reading = first_record<OdometryReading>(sample);
  return {reading.x_m, reading.y_m, reading.yaw_rad};
}

bool touches(const sim::SensorSample& sample) {
  for (std::uint32_t i = 0; i < sample.header->count; ++i) {
    ContactReading reading;
    std::memcpy(&reading, static_cast<const std::byte*>(sample.records) + i * sizeof reading,
                sizeof reading);
    if (reading.touching != 0) return true;
  }
  return false;
}

void note(ShadowReading& reading, double difference) {
  ++reading.compared;
  reading.last = difference;
  reading.most = std::max(reading.most, difference);
}

std::string_view unit_of(ReadingKind kind) {
  if (kind == ReadingKind::kRanges || kind == ReadingKind::kOdometry) return "m";
  return kind == ReadingKind::kContact ? "share" : "";
}

}  // namespace

Result<std::unique_ptr<Shadows>> Shadows::create(const config::ExpandedScenario& scenario,
                                                 plugin::Catalogue& catalogue,
                                                 const sim::Engine& engine, LogSink* log) {
  std::unique_ptr<Shadows> shadows(new Shadows(log));
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < scenario.robots.size(); ++r) {
    const config::RobotGroup& group = scenario.group_of(scenario.robots[r]);
    if (!group.shadow || !engine.is_local(RobotId(r))) continue;
    Shadow shadow;
    shadow.robot = RobotId(r);
    shadow.name = scenario.robots[r].name;
    const bool first = spec.types[spec.robots[r].type].simulated;
    // The type is made anew, because specs own parts of drivers and cannot be copied.
    const BuildOptions options;
    BuiltScenario scratch;
    RAVE_TRY_ASSIGN(auto type, make_type({scenario, catalogue, options, scratch},
                                         first ? group : twin_group(group)));
    RAVE_TRY_ASSIGN(shadow.world, ShadowWorld::create(engine, shadow.robot, std::move(type), log));
    shadows->shadows_.push_back(std::move(shadow));
  }
  if (shadows->shadows_.empty()) return std::unique_ptr<Shadows>();
  return shadows;
}

void Shadows::after_step(const StepView& step) {
  events_.clear();
  for (Shadow& shadow : shadows_) {
    shadow.fresh = false;
    if (shadow.world) follow(step, shadow);
  }
}

void Shadows::follow(const StepView& step, Shadow& shadow) {
  sim::Engine& engine = step.engine;
  const sim::EngineSpec& spec = engine.spec();
  const sim::ReportedPose& pose = engine.reported(shadow.robot);
  const bool real = !spec.types[spec.robots[shadow.robot.value()].type].simulated;
  const bool running = real && pose.known;
  const bool starts = running && (!shadow.now.running || (shadow.reset_asked && !pose.stale));
  std::optional<Pose2> start;
  if (starts) {
    // The reported pose is old by the delay of its source. It is extrapolated to now, as for other
    // hosts; the limit keeps a bad stamp from throwing the twin far away.
    const Duration age = std::clamp(engine.time() - pose.stamp, Duration{}, from_seconds(0.5));
    start =
        integrate({pose.pose.x_m, pose.pose.y_m, pose.pose.yaw_rad}, pose.velocity, age.seconds());
  }
  const Status done = shadow.world->step(engine, step.beside, start, running);
  if (!done) {
    if (log_ != nullptr) {
      log_->error("shadow", "the shadow of robot `{}` ends: {}", shadow.name, done.error().text());
    }
    shadow.now.running = false;
    shadow.world.reset();
    return;
  }
  // After the step, in which the twin was put at its place: the comparison begins with the next
  // pose.
  if (starts) begin(engine, shadow);
  shadow.now.running = running;
  if (running) compare(engine, shadow);
}

void Shadows::begin(const sim::Engine& engine, Shadow& shadow) {
  if (shadow.reset_asked && shadow.now.running) {
    events_.push_back({engine.steps_done() - 1, shadow.robot, sim::EventKind::kShadowReset,
                       BodyId(),
                       fmt::format("it was {:.3f} m and {:.1f} degrees away", shadow.now.m,
                                   rad_to_deg(shadow.now.rad))});
  }
  shadow.reset_asked = false;
  shadow.now = {};
  shadow.now.since = engine.time();
  shadow.compared_at = engine.time();
  shadow.next_moment_s = 0;
  ++shadow.starts;
  const sim::EngineSpec& spec = engine.spec();
  const auto& sensors = spec.types[spec.robots[shadow.robot.value()].type].sensors;
  shadow.seen.assign(sensors.size(), 0);
  shadow.odometry_R.assign(sensors.size(), Pose2{});
  shadow.odometry_S.assign(sensors.size(), Pose2{});
  for (std::uint32_t s = 0; s < sensors.size(); ++s) {
    shadow.now.readings.push_back({sensors[s].name, unit_of(sensors[s].kind)});
    // Readings from before the start were taken at another place than that of the twin.
    shadow.seen[s] = engine.sensor(shadow.robot, s).header->sequence;
  }
}

void Shadows::compare(const sim::Engine& engine, Shadow& shadow) {
  compare_readings(engine, shadow);
  const sim::ReportedPose& pose = engine.reported(shadow.robot);
  // Poses from before the shadow was placed cannot be compared with it.
  if (pose.stale || pose.stamp <= shadow.compared_at) return;
  // Both poses are taken at the same time. Otherwise the delay of the pose source would count as a
  // difference: 0.1 s at 0.5 m/s are 5 cm.
  const auto X_WS = shadow.world->pose_at(pose.stamp);
  if (!X_WS) return;
  ShadowDifference& now = shadow.now;
  shadow.fresh = true;
  ++now.compared;
  ++shadow.ever_compared;
  shadow.compared_at = pose.stamp;
  shadow.X_WR = {pose.pose.x_m, pose.pose.y_m, pose.pose.yaw_rad};
  shadow.X_WS = *X_WS;
  now.m = distance_m(shadow.X_WR, *X_WS);
  now.rad = std::abs(wrap_angle(shadow.X_WR.yaw - X_WS->yaw));
  now.most_m = std::max(now.most_m, now.m);
  now.most_rad = std::max(now.most_rad, now.rad);
  shadow.ever_m = std::max(shadow.ever_m, now.m);
  shadow.ever_rad = std::max(shadow.ever_rad, now.rad);
  keep_moment(pose.stamp.seconds(), shadow);
}

void Shadows::compare_readings(const sim::Engine& engine, Shadow& shadow) {
  for (std::uint32_t s = 0; s < shadow.now.readings.size(); ++s) {
    ShadowReading& reading = shadow.now.readings[s];
    const sim::SensorSample real = engine.sensor(shadow.robot, s);
    const bool newer = real.header->sequence != shadow.seen[s] && real.header->count > 0 &&
                       real.header->stamp_ns > shadow.now.since.ns;
    if (reading.unit.empty() || !newer) continue;
    const sim::SensorSample theirs = shadow.world->engine().sensor(shadow.robot, s);
    switch (real.info->kind) {
      case ReadingKind::kRanges:
        compare_ranges(real, s, shadow);
        break;
      case ReadingKind::kContact: {
        // The running mean of 0 and 1 is the share of readings that differ.
        const double before = reading.last * static_cast<double>(reading.compared);
        const bool differs = touches(real) != touches(theirs);
        note(reading, (before + (differs ? 1 : 0)) / static_cast<double>(reading.compared + 1));
        break;
      }
      case ReadingKind::kOdometry: {
        if (theirs.header->count == 0) continue;
        const Pose2 X_R = odometry_of(real);
        const Pose2 X_S = odometry_of(theirs);
        // Odometry of either robot has an origin of its own. Only the ways since the first common
        // reading are comparable.
        if (reading.compared == 0) {
          shadow.odometry_R[s] = X_R;
          shadow.odometry_S[s] = X_S;
        }
        note(reading, distance_m(compose(inverse(shadow.odometry_R[s]), X_R),
                                 compose(inverse(shadow.odometry_S[s]), X_S)));
        break;
      }
      default:
        break;
    }
    shadow.seen[s] = real.header->sequence;
  }
}

/// The scan that the shadow would have received at the stamp of the real scan, without noise.
void Shadows::compare_ranges(const sim::SensorSample& real, std::uint32_t sensor, Shadow& shadow) {
  sim::Engine& engine = shadow.world->engine();
  const sim::SensorSample theirs = engine.sensor(shadow.robot, sensor);
  if (theirs.info->capacity != real.info->capacity) return;
  ranges_.resize(theirs.info->capacity);
  const auto seen =
      engine.sample_at(shadow.robot, sensor, SimTime{real.header->stamp_ns}, ranges_.data());
  if (!seen) return;
  const std::uint32_t count = std::min(seen->count, real.header->count);
  double sum_m = 0;
  std::uint32_t both = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    float range_m = 0;
    std::memcpy(&range_m, static_cast<const std::byte*>(real.records) + i * sizeof range_m,
                sizeof range_m);
    // A ray that met nothing for one of the two has no difference in metres.
    if (!std::isfinite(range_m) || !std::isfinite(ranges_[i])) continue;
    sum_m += std::abs(static_cast<double>(range_m) - static_cast<double>(ranges_[i]));
    ++both;
  }
  if (both > 0) note(shadow.now.readings[sensor], sum_m / both);
}

void Shadows::keep_moment(double time_s, Shadow& shadow) const {
  const double after_s = time_s - shadow.now.since.seconds();
  if (after_s < shadow.next_moment_s) return;
  shadow.moments.push_back({time_s, after_s, shadow.now.m, shadow.now.rad});
  shadow.next_moment_s = after_s + shadow.moment_every_s;
  if (shadow.moments.size() <= kMostMoments) return;
  std::size_t kept = 0;
  // Thinning keeps the memory constant and the moments evenly spread over a run of any length.
  for (std::size_t i = 0; i < shadow.moments.size(); i += 2) {
    shadow.moments[kept++] = shadow.moments[i];
  }
  shadow.moments.resize(kept);
  shadow.moment_every_s *= 2;
}

void Shadows::record(record::RunRecorder& recorder) const {
  for (const Shadow& shadow : shadows_) {
    if (!shadow.fresh) continue;
    record::ShadowRecord recorded;
    recorded.robot = shadow.robot;
    recorded.X_WR = shadow.X_WR;
    recorded.X_WS = shadow.X_WS;
    recorded.m = shadow.now.m;
    recorded.rad = shadow.now.rad;
    for (const ShadowReading& reading : shadow.now.readings) {
      recorded.readings.push_back(reading.compared > 0 ? reading.last
                                                       : std::numeric_limits<double>::quiet_NaN());
    }
    // A failure is already in the log.
    static_cast<void>(recorder.shadow(recorded));
  }
}

Result<std::string> Shadows::reset(std::string_view robot) {
  std::vector<std::string_view> names;
  std::vector<std::string_view> asked;
  for (Shadow& shadow : shadows_) {
    names.push_back(shadow.name);
    if (!robot.empty() && robot != shadow.name) continue;
    if (!shadow.world) {
      return fail(ErrorCode::kState, "the shadow of robot `{}` has ended", shadow.name);
    }
    shadow.reset_asked = true;
    asked.push_back(shadow.name);
  }
  if (asked.empty()) {
    return fail(ErrorCode::kNotFound, "robot `{}` has no shadow; these robots have one: {}{}",
                robot, join_names(names), suggestion(robot, names));
  }
  return "in the next step the shadow restarts at the pose of the robot: " + join_names(asked);
}

void Shadows::refresh(RunStatus& status) const {
  for (RunStatus::Robot& robot : status.robots) {
    for (const Shadow& shadow : shadows_) {
      if (shadow.name != robot.name) continue;
      RunStatus::Shadow& told = *(robot.shadow = RunStatus::Shadow{});
      told.running = shadow.now.running;
      told.since_s = shadow.now.since.seconds();
      told.m = shadow.now.m;
      told.rad = shadow.now.rad;
      told.most_m = shadow.now.most_m;
      told.most_rad = shadow.now.most_rad;
      if (shadow.now.compared > 0) {
        told.offset_W = Pose2{shadow.X_WS.x - shadow.X_WR.x, shadow.X_WS.y - shadow.X_WR.y,
                              wrap_angle(shadow.X_WS.yaw - shadow.X_WR.yaw)};
      }
      for (const ShadowReading& reading : shadow.now.readings) {
        if (reading.compared == 0) continue;
        told.readings.push_back(
            {reading.sensor, std::string(reading.unit), reading.last, reading.most});
      }
    }
  }
}

std::vector<ShadowFacts> Shadows::facts() const {
  std::vector<ShadowFacts> all;
  for (const Shadow& shadow : shadows_) {
    const ShadowDifference& now = shadow.now;
    Json readings = Json::object();
    for (const ShadowReading& reading : now.readings) {
      if (reading.unit.empty()) continue;
      readings[reading.sensor] = {{"unit", reading.unit},
                                  {"last", number_of(reading.compared, reading.last)},
                                  {"most", number_of(reading.compared, reading.most)},
                                  {"compared", reading.compared}};
    }
    Json moments = Json::array();
    for (const Moment& moment : shadow.moments) {
      moments.push_back({{"time_s", rounded(moment.time_s)},
                         {"after_s", rounded(moment.after_s)},
                         {"m", rounded(moment.m)},
                         {"rad", rounded(moment.rad)}});
    }
    const Json report = {
        {"robot", shadow.name},
        {"starts", shadow.starts},
        {"whole", shadow.world != nullptr},
        {"compared", shadow.ever_compared},
        {"last",
         {{"m", number_of(now.compared, now.m)}, {"rad", number_of(now.compared, now.rad)}}},
        {"most",
         {{"m", number_of(shadow.ever_compared, shadow.ever_m)},
          {"rad", number_of(shadow.ever_compared, shadow.ever_rad)}}},
        {"readings", std::move(readings)},
        {"moments", std::move(moments)}};
    all.push_back({shadow.robot.value(), report.dump()});
  }
  return all;
}

}  // namespace rave::runtime
