// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_gps.hpp"

#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {

Status Ros2Gps::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  RAVE_TRY_ASSIGN(const GeoFrame frame, read_geo_origin(params.numbers("geo_origin")));
  GpsOptions options;
  options.doubt = read_doubt(params);
  options.course_distance_m = params.number("course_distance_m");
  options.antenna_m = {params.number("antenna_x_m"), params.number("antenna_y_m")};
  options.has_imu = !params.text("imu_topic").empty();
  track_.emplace(frame, options);
  RAVE_TRY(make_reader(params.text("topic"), main_));
  if (options.has_imu) {
    RAVE_TRY(make_reader(params.text("imu_topic"), beside_));
    RAVE_TRY(device().await(*beside_, [this](const ros2::Imu& message, std::uint64_t writer) {
      return counts_beside(writer) && hear(message);
    }));
  }
  // The run starts only when there is a usable fix, since a robot without a pose cannot be in the
  // world.
  return device().await(*main_, [this](const ros2::NavSatFix& fix, std::uint64_t writer) {
    hear_imu();
    return counts(writer) && pose_of(fix).has_value();
  });
}

bool Ros2Gps::hear(const ros2::Imu& message) {
  Status heard = track_->hear(message);
  if (heard) return true;
  beside_->refuse(std::move(heard).error());
  return false;
}

void Ros2Gps::hear_imu() {
  if (!beside_) return;
  beside_->take([this](const ros2::Imu& message, std::uint64_t writer) {
    if (counts_beside(writer)) hear(message);
  });
}

bool Ros2Gps::counts(std::uint64_t writer) { return admits(fixes_, main_->end(), writer); }

bool Ros2Gps::counts_beside(std::uint64_t writer) {
  return admits(orientations_, beside_->end(), writer);
}

std::optional<PoseReading> Ros2Gps::pose_of(const ros2::NavSatFix& fix) {
  auto reading = track_->take(fix);
  if (reading) return *reading;
  main_->refuse(std::move(reading).error());
  return std::nullopt;
}

void Ros2Gps::drain() {
  hear_imu();
  main_->take([this](const ros2::NavSatFix& fix, std::uint64_t writer) {
    if (!counts(writer)) return;
    const auto reading = pose_of(fix);
    if (reading) {
      publish(track_->stamp_ns(fix), &*reading, 1);
    } else {
      // The receiver works even though it has no fix; only silence is a failure.
      note_alive();
    }
  });
}

}  // namespace rave::ros2_driver
