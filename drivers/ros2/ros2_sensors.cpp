// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_sensors.hpp"

#include <algorithm>

#include "rave/bus/sequence.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {

Status Ros2Laser::prepare(const Params& params, HardwareDeclaration& declaration) {
  RAVE_TRY(begin_reading(params, [this](const ros2::LaserScan& scan) {
    // The first scan tells the geometry, which ROS 2 publishes nowhere else.
    fan_ = fan_of(scan);
    return true;
  }));
  zero_ = params.text("zero") == "no_return" ? Zero::kNoReturn : Zero::kNoReading;
  bearings_rad_ = bearings_of(fan_);
  ranges_m_.resize(fan_.rays);
  declaration.capacity = fan_.rays;
  declaration.range_min_m = fan_.range_min_m;
  declaration.range_max_m = fan_.range_max_m;
  declaration.bearings_rad = bearings_rad_.data();
  return {};
}

Status Ros2Laser::take(const ros2::LaserScan& message) {
  RAVE_TRY(ranges_of(message, fan_, ranges_m_, zero_));
  publish(ros2::nanoseconds(message.header.stamp), ranges_m_.data(), fan_.rays);
  return {};
}

Status Ros2Range::prepare(const Params& params, HardwareDeclaration& declaration) {
  RAVE_TRY(begin_reading(params, [&](const ros2::RangeReading& message) {
    declaration.range_min_m = message.min_range;
    declaration.range_max_m = message.max_range;
    declaration.cone_rad = message.field_of_view;
    return true;
  }));
  declaration.capacity = 1;
  declaration.bearings_rad = &bearing_rad_;
  return {};
}

Status Ros2Range::take(const ros2::RangeReading& message) {
  if (!says_something({&message.range, 1})) {
    return fail(ErrorCode::kInvalidArgument,
                "the range is {}, which is not a valid reading; no return is +infinity (REP-117)",
                message.range);
  }
  const float range_m = range_of(message.range, message.min_range, message.max_range);
  publish(ros2::nanoseconds(message.header.stamp), &range_m, 1);
  return {};
}

Status Ros2TfPose::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  doubt_ = read_doubt(params);
  map_frame_ = params.text("map_frame");
  base_frame_ = params.text("base_frame");
  // Many nodes publish on /tf, so bursts are longer than on other topics. Static transforms are
  // sent once and kept for late readers.
  RAVE_TRY(make_reader(params.text("topic"), main_, ros2::kReadMany));
  RAVE_TRY(make_reader(params.text("static_topic"), beside_, ros2::kReadKept));
  return await_chain();
}

Status Ros2TfPose::await_chain() {
  std::string missing;
  Status heard = device().await(
      *main_, [this, &missing](const ros2::TfMessage& message, dds_instance_handle_t writer) {
        add_static();
        if (!add(*main_, message, writer, false)) return false;
        const auto found = tree_.find(map_frame_, base_frame_);
        missing = found ? "" : found.error().message;
        return found.has_value();
      });
  if (heard || missing.empty()) return heard;
  return fail(ErrorCode::kTimeout, "`{}` has no pose of the robot: {}", topic(), missing);
}

bool Ros2TfPose::add(ros2::Reader<ros2::TfMessage>& reader, const ros2::TfMessage& message,
                     dds_instance_handle_t writer, bool is_static) {
  bool any = false;
  for (const ros2::TransformStamped& each : bus::elements(message.transforms)) {
    const std::string_view child = TfTree::frame(each.child_frame_id);
    // Many nodes write other frames, which may be anybody's.
    if (tree_.needs(child, base_frame_)) {
      auto choice = writers_.find(child);
      if (choice == writers_.end()) choice = writers_.try_emplace(std::string(child)).first;
      if (!admits(choice->second, reader.end(), writer, child, is_static)) continue;
    }
    Status added = tree_.add(each, is_static);
    if (!added) {
      reader.refuse(std::move(added).error());
      return false;
    }
    any = true;
  }
  return any;
}

void Ros2TfPose::add_static() {
  beside_->take([this](const ros2::TfMessage& message, dds_instance_handle_t writer) {
    add(*beside_, message, writer, true);
  });
}

void Ros2TfPose::drain() {
  add_static();
  // After each message, so that every pose of a burst is published.
  main_->take([this](const ros2::TfMessage& message, dds_instance_handle_t writer) {
    if (!add(*main_, message, writer, false)) return;
    auto found = tree_.find(map_frame_, base_frame_);
    if (!found) {
      main_->refuse(std::move(found).error());
      return;
    }
    // Most messages contain other frames only, or only one of the transforms that the pose needs.
    if (found->stamp_ns == last_ns_) return;
    last_ns_ = found->stamp_ns;
    const PoseReading reading{found->X_AB.x, found->X_AB.y, found->X_AB.yaw, doubt_.variance_xy_m2,
                              doubt_.variance_yaw_rad2};
    publish(found->stamp_ns, &reading, 1);
  });
}

std::string Ros2TfPose::explain_silence() const {
  const auto found = tree_.find(map_frame_, base_frame_);
  return found ? main_->explain_silence() : found.error().message;
}

}  // namespace rave::ros2_driver
