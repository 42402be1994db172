// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rave/math/transform.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("range_min_m", "m", 0.9, 0, 1000, "Smallest distance at which a code is read."),
    number_param("range_max_m", "m", 8.7, 0, 1000, "Largest distance at which a code is read."),
    number_param("fov_min_deg", "deg", -34, -180, 180, "Right edge of the field of view."),
    number_param("fov_max_deg", "deg", 33, -180, 180, "Left edge of the field of view."),
    bool_param("occlusion", true, "Whether bodies between hide a code."),
    integer_param("max_sightings", 32, 1, 4096, "Largest number of codes in one image."),
};

/// A camera that reads barcodes: range and bearing to the axis of every landmark in its field of
/// view.
class VirtualLandmarkCamera final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kSightings;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    RAVE_TRY(check_ascending(params, "fov_min_deg", "fov_max_deg"));
    range_min_m_ = params.number("range_min_m");
    range_max_m_ = params.number("range_max_m");
    fov_min_rad_ = deg_to_rad(params.number("fov_min_deg"));
    fov_max_rad_ = deg_to_rad(params.number("fov_max_deg"));
    occlusion_ = params.flag("occlusion");
    layers_ = setup.layers;
    declaration.capacity = static_cast<std::uint32_t>(params.integer("max_sightings"));
    return {};
  }

  void sample(const WorldView& world, const SampleItem& item) const override {
    auto* const sightings = static_cast<Sighting*>(item.records);
    const SinCos heading = sincos(item.X_WS.yaw);
    std::uint32_t count = 0;
    for (const Landmark& landmark : world.landmarks()) {
      if (count == item.capacity) break;
      if (landmark.robot == item.robot || !contains(layers_, world.layer_of(landmark.body))) {
        continue;
      }
      const Vec2 p_SL = rotate_back(heading, landmark.p_WL - item.X_WS.position());
      const double squared_range = squared_norm(p_SL);
      // Squares save the root for the many landmarks out of range.
      if (squared_range < range_min_m_ * range_min_m_ ||
          squared_range > range_max_m_ * range_max_m_) {
        continue;
      }
      const double bearing_rad = atan2(p_SL.y, p_SL.x);
      if (bearing_rad < fov_min_rad_ || bearing_rad > fov_max_rad_) continue;
      // Last, because it casts up to three rays; the other conditions are a few operations.
      if (occlusion_ && !readable(world, item, landmark)) continue;
      Sighting& sighting = sightings[count++];
      sighting.stamp_ns = world.time().ns;
      sighting.code = landmark.code;
      sighting.range_m = static_cast<float>(std::sqrt(squared_range));
      sighting.bearing_rad = static_cast<float>(bearing_rad);
      sighting.reserved = 0;
    }
    item.header->count = count;
  }

 private:
  /// The line of sight is at the height of the code nearest to the camera's own. The code surrounds
  /// its body, so it is readable from any visible part of the width: the centre and points near the
  /// edges are tested.
  [[nodiscard]] bool readable(const WorldView& world, const SampleItem& item,
                              const Landmark& landmark) const {
    constexpr double kNearlyEdge = 0.9;
    const double z_m = std::max(landmark.z0_m, std::min(item.z_m, landmark.z1_m));
    const Vec2 p_from = item.X_WS.position();
    const Vec2 line = landmark.p_WL - p_from;
    const double range_m = std::sqrt(squared_norm(line));
    const double share = range_m > 0 ? kNearlyEdge * landmark.radius_m / range_m : 0;
    // At right angles to the line of sight, 0.9 radii away from the axis.
    const Vec2 aside{-share * line.y, share * line.x};
    for (const Vec2 offset : {Vec2{}, aside, -aside}) {
      if (world.visible(p_from, landmark.p_WL + offset, z_m, layers_, world.body_of(item.robot),
                        landmark.body)) {
        return true;
      }
    }
    return false;
  }

  double range_min_m_ = 0;
  double range_max_m_ = 0;
  double fov_min_rad_ = 0;
  double fov_max_rad_ = 0;
  bool occlusion_ = true;
  LayerMask layers_ = kAllLayers;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_landmark_camera") {
  rave::add_virtual_sensor<rave::VirtualLandmarkCamera>(
      registry, {.name = "virtual_landmark_camera",
                 .summary = "Range, bearing and code of each readable barcode.",
                 .params = rave::kParams});
}
