// SPDX-License-Identifier: Apache-2.0
// The two sets of drivers of a robot: made, opened, exchanged.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "hand_overs.hpp"
#include "rave/math/finite.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {
namespace {

/// Bearings of a real and a virtual laser may be so far apart.
constexpr double kSameBearing_rad = deg_to_rad(1.0);

double distance_m(const Pose2& a, const Pose2& b) noexcept {
  return std::sqrt(squared_norm(a.position() - b.position()));
}

/// Whether what one set gives can be put where the program expects what the other gave.
Status check_readings(const RobotGroup& group, const RobotGroup& other) {
  for (std::size_t s = 0; s < other.sensors.size(); ++s) {
    const SensorInfo& told = group.sensor_infos[s];
    const SensorInfo& info = other.sensors[s].info;
    // What each value means follows from its place, and the program was told how many there are.
    if (info.kind == ReadingKind::kValues && info.capacity != told.capacity) {
      return fail(ErrorCode::kInvalidArgument,
                  "sensor `{}` gives up to {} values, but the program expects {}", told.name,
                  info.capacity, told.capacity);
    }
    if (info.kind != ReadingKind::kRanges) {
      const bool isolated = group.program.spec != nullptr && group.program.spec->isolate;
      if (!isolated || info.capacity <= told.capacity) continue;
      return fail(ErrorCode::kInvalidArgument,
                  "sensor `{}` may give {} readings, but the isolated program has room for {}",
                  told.name, info.capacity, told.capacity);
    }
    if (info.capacity != told.capacity) {
      return fail(ErrorCode::kInvalidArgument,
                  "sensor `{}` gives {} ranges, but the program expects {}", told.name,
                  info.capacity, told.capacity);
    }
    if (told.bearings_rad == nullptr && info.bearings_rad == nullptr) continue;
    if (told.bearings_rad == nullptr || info.bearings_rad == nullptr) {
      return fail(ErrorCode::kInvalidArgument,
                  "sensor `{}`: only one set of drivers states the bearings of its ranges",
                  told.name);
    }
    for (std::uint32_t i = 0; i < info.capacity; ++i) {
      const double apart_rad = std::abs(wrap_angle(told.bearings_rad[i] - info.bearings_rad[i]));
      if (apart_rad <= kSameBearing_rad) continue;
      return fail(ErrorCode::kInvalidArgument,
                  "sensor `{}`: range {} is at {:.2f} degrees, but the program expects {:.2f}",
                  told.name, i, rad_to_deg(info.bearings_rad[i]), rad_to_deg(told.bearings_rad[i]));
    }
  }
  return {};
}

/// A recording cannot begin in the middle.
Status check_live(const RobotGroup& other) {
  for (const SensorSlots& slots : other.sensors) {
    if (slots.is_virtual() || slots.live) continue;
    return fail(ErrorCode::kInvalidArgument,
                "sensor `{}` (driver `{}`) plays a recording, which cannot start during a run",
                slots.spec->name, slots.spec->hardware_driver());
  }
  return {};
}

void throw_away(RobotGroup& other) {
  close_group(other);
  other.guards.clear();
  other.actuators.clear();
  other.sensors.clear();
  other.devices.clear();
}

/// The program keeps the last sample of the sensor until the new one gives one, and sees numbers
/// that continue.
void carry_sample(const SensorSlots& from, SensorSlots& to) {
  // Numbers also name random numbers: none may be used twice in a run.
  to.sequence[0] = from.sequence[0];
  SampleHeader& header = to.headers[0];
  header = from.headers[0];
  header.count = std::min(header.count, to.capacity);
  const std::size_t bytes = std::size_t{header.count} * record_size(to.spec->kind);
  if (bytes > 0) std::memcpy(to.records_of(0), from.records.data(), bytes);
}

}  // namespace

void HandOvers::make(const Radio* radio) {
  radio_ = radio;
  for (std::uint32_t r = 0; r < spec_.robots.size(); ++r) {
    if (!spec_.robots[r].twin || !roster_.is_local(RobotId(r))) continue;
    Twin& twin = twins_.emplace_back();
    twin.robot = RobotId(r);
    twin.types = {spec_.robots[r].type, *spec_.robots[r].twin};
    twin.other.type = &spec_.types[twin.types[1]];
    twin.other.members = {twin.robot};
  }
}

const Twin* HandOvers::find(RobotId robot) const noexcept {
  const auto found = std::ranges::find(twins_, robot, &Twin::robot);
  return found == twins_.end() ? nullptr : &*found;
}

const RobotType* HandOvers::other_type(RobotId robot) const noexcept {
  const Twin* const twin = find(robot);
  return twin == nullptr ? nullptr : twin->other.type;
}

Status HandOvers::restore() {
  if (!close()) {
    return fail(ErrorCode::kState,
                "the run cannot restart while drivers of a hand-over are opening or closing");
  }
  for (Twin& twin : twins_) {
    if (twin.state.active != DriverSet::kFirst) {
      // Before the exchange: what serves now is the other set from then on, and would stay open.
      if (!site_.close_all(take_open(group_of(twin)))) {
        return fail(ErrorCode::kState,
                    "the run cannot restart while drivers of the last run are closing");
      }
      exchange(twin);
      site_.drivers_restored(twin.robot);
    }
    group_of(twin).X_WM.reset();
    twin.stage = Twin::Stage::kIdle;
    twin.state = {};
  }
  return {};
}

/// Maybe in a thread of its own: touches nothing but the set that does not serve.
Status HandOvers::open_other(Twin& twin) {
  const GroupContext context{spec_, roster_.logs, radio_, &twin.opening};
  // Made once. Later hand-overs open the same instances again, as a reset does.
  if (!twin.made) {
    Status made = make_body(context, twin.other);
    if (made) made = check_readings(group_of(twin), twin.other);
    if (made) made = check_live(twin.other);
    if (!made) {
      throw_away(twin.other);
      return made;
    }
    twin.made = true;
  }
  Status opened = check_live(twin.other);
  if (opened) opened = open_body(context, twin.other);
  twin.opening.clear();
  // After the end of the run nothing else does.
  if (!opened || twin.left) close_group(twin.other);
  return opened;
}

/// Where the robot is when the other set serves, and the frame of its pose source.
Arrival HandOvers::arrival(const Twin& twin) const {
  const std::uint32_t r = twin.robot.value();
  const RobotType& type = *twin.other.type;
  Arrival place{truth_.movers[r].X_WR, {}, std::nullopt, now_};
  if (!type.pose_from) return place;
  const PoseReading heard = twin.heard.value_or(PoseReading{});
  const Pose2 X_MR{heard.x_m, heard.y_m, heard.yaw_rad};
  if (type.sensors[*type.pose_from].kind == ReadingKind::kOdometry) {
    // Wheels count from wherever they were switched on: that place is chosen so that it fits.
    // X_WM X_MR = X_WR
    place.X_WM = compose(place.X_WR, inverse(X_MR));
  } else if (twin.heard) {
    place.X_WR = compose(type.X_WM.value_or(Pose2{}), X_MR);
  }
  if (twin.heard) {
    place.variance = heard;
    place.stamp = twin.heard_at;
  }
  return place;
}

Status HandOvers::check_near(const Twin& twin) const {
  const std::uint32_t r = twin.robot.value();
  if (!truth_.movers[r].present) {
    return fail(ErrorCode::kState, "its pose is not known yet");
  }
  const Pose2 X_before = truth_.movers[r].X_WR;
  const Pose2 X_after = arrival(twin).X_WR;
  const double apart_m = distance_m(X_before, X_after);
  const double turned_rad = std::abs(wrap_angle(X_after.yaw - X_before.yaw));
  // Farther apart than this, one of both sets is wrong about the place, and the robot would jump.
  const HandOverLimits& limits = spec_.robots[r].hand_over;
  const bool finite = is_finite(X_after);
  if (finite && apart_m <= limits.within_m && turned_rad <= limits.within_rad) return {};
  return fail(ErrorCode::kState,
              "its {} drivers report ({:.3f}, {:.3f}) m, {:.1f} degrees, which is {:.3f} m and "
              "{:.1f} degrees from its present pose; expected at most {} m and {:.0f} degrees",
              reality_of(*twin.other.type), X_after.x, X_after.y, rad_to_deg(X_after.yaw), apart_m,
              rad_to_deg(turned_rad), limits.within_m, rad_to_deg(limits.within_rad));
}

/// The sets change places; program and controllers stay.
void HandOvers::exchange(Twin& twin) {
  RobotGroup& group = group_of(twin);
  std::swap(group.type, twin.other.type);
  std::swap(group.devices, twin.other.devices);
  std::swap(group.sensors, twin.other.sensors);
  std::swap(group.actuators, twin.other.actuators);
  std::swap(group.guards, twin.other.guards);
  for (std::size_t s = 0; s < group.sensors.size(); ++s) {
    group.sensor_infos[s].max_age_s = group.sensors[s].info.max_age_s;
  }
  // The views of the program point to the sensors that have just changed places.
  show_sensors(group);
  const bool first = twin.state.active == DriverSet::kFirst;
  twin.state.active = first ? DriverSet::kTwin : DriverSet::kFirst;
  RobotSpec& robot = spec_.robots[twin.robot.value()];
  robot.type = twin.type_of(twin.state.active);
  robot.twin = twin.type_of(first ? DriverSet::kFirst : DriverSet::kTwin);
}

void HandOvers::change_drivers(Twin& twin) {
  const std::uint32_t r = twin.robot.value();
  RobotGroup& group = group_of(twin);
  const Pose2 X_before = truth_.movers[r].X_WR;
  const Arrival place = arrival(twin);
  // The old hardware stands before anything else: after the exchange nothing commands it.
  site_.halt(group);
  for (std::size_t s = 0; s < group.sensors.size(); ++s) {
    carry_sample(group.sensors[s], twin.other.sensors[s]);
  }
  exchange(twin);
  const RobotType& type = *group.type;
  group.X_WM = place.X_WM;
  site_.drivers_changed(twin.robot, place);
  // After the exchange, twin.other is the set that has served. Guards of the new set start last,
  // when the old ones no longer know of the robot.
  close_other(twin);
  const Status guarded = site_.start_guards(group);
  if (!guarded) {
    // Steps that come late would guard it late: it stands until a person who knows that releases
    // it.
    guards_[r].stop();
    if (spec_.log != nullptr) {
      spec_.log->error("guard",
                       "{}; the robot is stopped, and after a release only the steps of the "
                       "run guard it",
                       guarded.error().text());
    }
  }
  ++twin.state.made;
  const double jump_m = distance_m(X_before, place.X_WR);
  const double turn_rad = std::abs(wrap_angle(place.X_WR.yaw - X_before.yaw));
  std::string text = fmt::format(
      "{} -> {} at ({:.3f}, {:.3f}) m, {:.1f} degrees; moved by {:.4f} m and {:.2f} degrees",
      reality_of(*twin.other.type), reality_of(type), place.X_WR.x, place.X_WR.y,
      rad_to_deg(place.X_WR.yaw), jump_m, rad_to_deg(turn_rad));
  if (!guards_[r].holds().armed) text += "; it stands until it is armed";
  if (!guarded) text += "; it is stopped, because its guard has no thread";
  end(twin, EventKind::kHandedOver, std::move(text));
}

void HandOvers::close_other(Twin& twin) {
  site_.before_closing(twin.other);
  if (spec_.live_clock == nullptr) return close_group(twin.other);
  twin.work = SideTask::in_thread([&twin]() -> Status {
    close_group(twin.other);
    return {};
  });
}

std::string HandOvers::still_busy(const Twin& twin) {
  const std::string opening = twin.opening.text();
  return fmt::format("its {} drivers, which do not serve, are still being {}{}{}",
                     reality_of(*twin.other.type),
                     opening.empty() ? "made or closed" : "opened: ", opening,
                     opening.empty() ? "" : " has not returned");
}

bool HandOvers::close() noexcept {
  const auto end = std::chrono::steady_clock::now() + spec_.last_wait;
  bool all = true;
  std::vector<ToClose> open;
  for (Twin& twin : twins_) {
    // One moment for all of them, so that several that hang do not add up.
    if (!twin.work.ready_by(end)) {
      all = false;
      if (spec_.log == nullptr) continue;
      spec_.log->error(roster_.logs[twin.robot.value()].source, "{}; the run ends without it",
                       still_busy(twin));
      continue;
    }
    twin.work.wait();
    twin.work = {};
    twin.given_up = false;
    twin.stage = Twin::Stage::kIdle;
    twin.state.under_way = false;
    const std::vector<ToClose> more = take_open(twin.other);
    open.insert(open.end(), more.begin(), more.end());
  }
  return site_.close_all(std::move(open)) && all;
}

void HandOvers::leave_behind(const std::function<void(const RobotType&)>& keep) noexcept {
  for (Twin& twin : twins_) {
    if (twin.work.ready()) {
      static_cast<void>(site_.close_all(take_open(twin.other)));
      continue;
    }
    twin.left = true;
    keep(*twin.other.type);
    twin.work.leave_alone();
  }
}

}  // namespace rave::sim
