// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "rave/math/gaussian.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("sigma_xy_m", "m", 0.02, 0, 100, "Standard deviation of x and of y."),
    number_param("sigma_yaw_deg", "deg", 0.5, 0, 180, "Standard deviation of the heading."),
    number_param("dropout_probability", "", 0, 0, 1, "Probability that a sample has no pose."),
    numbers_param("dropout_zones_m", "m", -1e6, 1e6,
                  "Rectangles without reception, four numbers each: x_min, y_min, x_max, y_max."),
};

/// An axis-aligned rectangle in W, border included.
struct Zone {
  double x_min_m = 0;
  double y_min_m = 0;
  double x_max_m = 0;
  double y_max_m = 0;

  [[nodiscard]] bool holds(const Pose2& pose) const noexcept {
    return pose.x >= x_min_m && pose.x <= x_max_m && pose.y >= y_min_m && pose.y <= y_max_m;
  }
};

Result<std::vector<Zone>> read_zones(std::span<const double> numbers) {
  if (numbers.size() % 4 != 0) {
    return fail(
        ErrorCode::kInvalidArgument,
        "`dropout_zones_m` has {} numbers; each zone takes four: x_min, y_min, x_max, y_max",
        numbers.size());
  }
  std::vector<Zone> zones;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    const Zone zone{numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
    if (!(zone.x_min_m < zone.x_max_m && zone.y_min_m < zone.y_max_m)) {
      return fail(ErrorCode::kInvalidArgument,
                  "zone {} of `dropout_zones_m` is {}, {}, {}, {}: x_min must be smaller than "
                  "x_max and y_min smaller than y_max",
                  i / 4 + 1, zone.x_min_m, zone.y_min_m, zone.x_max_m, zone.y_max_m);
    }
    zones.push_back(zone);
  }
  return zones;
}

/// An indoor GPS: the pose of the robot in W with noise, drop-outs and dead zones.
class IndoorPositioning final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& /*declaration*/) override {
    const Params params = setup.parameters();
    sigma_xy_m_ = params.number("sigma_xy_m");
    sigma_yaw_rad_ = deg_to_rad(params.number("sigma_yaw_deg"));
    dropout_probability_ = params.number("dropout_probability");
    RAVE_TRY_ASSIGN(zones_, read_zones(params.numbers("dropout_zones_m")));
    return {};
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    RandomStream random = item.random();
    // Always drawn, so that a zone does not change the noise of other samples.
    const bool lost = random.uniform() < dropout_probability_;
    const auto in_zone = [&](const Zone& zone) { return zone.holds(item.X_WR); };
    if (lost || std::any_of(zones_.begin(), zones_.end(), in_zone)) {
      item.header->count = 0;
      return;
    }
    auto& reading = *static_cast<PoseReading*>(item.records);
    reading.x_m = item.X_WR.x + sigma_xy_m_ * gaussian(random);
    reading.y_m = item.X_WR.y + sigma_xy_m_ * gaussian(random);
    reading.yaw_rad = wrap_angle(item.X_WR.yaw + sigma_yaw_rad_ * gaussian(random));
    // The stated variance is the true one, so estimators of programs can be tested against it.
    reading.variance_xy_m2 = sigma_xy_m_ * sigma_xy_m_;
    reading.variance_yaw_rad2 = sigma_yaw_rad_ * sigma_yaw_rad_;
    item.header->count = 1;
  }

 private:
  double sigma_xy_m_ = 0;
  double sigma_yaw_rad_ = 0;
  double dropout_probability_ = 0;
  std::vector<Zone> zones_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("indoor_positioning") {
  rave::add_virtual_sensor<rave::IndoorPositioning>(
      registry, {.name = "indoor_positioning",
                 .summary = "The robot's pose in the world with noise, drop-outs and dead zones.",
                 .params = rave::kParams});
}
