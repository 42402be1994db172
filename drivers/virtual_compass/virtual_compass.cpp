// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include "rave/math/gaussian.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr std::size_t kNumbersPerRegion = 5;

constexpr ParamSpec kParams[] = {
    number_param("north_deg", "deg", 90, -360, 360,
                 "Direction of magnetic north in the world, counter-clockwise from its x axis."),
    number_param("noise_share", "", 0.01, 0, 1,
                 "Standard deviation of each component of the field, as a share of the earth's; "
                 "0.01 makes a heading noise of about 0.01 rad."),
    number_param(
        "hard_iron_x", "", 0, -10, 10,
        "Field of the robot's own magnets along the x axis of the sensor, as a share of the "
        "earth's."),
    number_param("hard_iron_y", "", 0, -10, 10, "The same along the y axis."),
    numbers_param("disturbed", "", -1e6, 1e6,
                  "Disturbed regions, five numbers each: x and y of the middle in m, radius in m, "
                  "strength of the field in the middle as a share of the earth's, its direction in "
                  "the world in deg. The field falls to 0 at the edge."),
};

/// A circle with a field of its own.
struct Region {
  Vec2 p_W;
  double radius_m = 0;
  Vec2 field_W;  ///< In the middle.
};

/// A compass: the heading of its x axis, found from the horizontal magnetic field where it is.
class VirtualCompass final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    const SinCos north = sincos(deg_to_rad(params.number("north_deg")));
    north_W_ = {north.cos, north.sin};
    noise_share_ = params.number("noise_share");
    hard_iron_S_ = {params.number("hard_iron_x"), params.number("hard_iron_y")};
    declaration.capacity = 2;
    return read_regions(params.numbers("disturbed"));
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    Vec2 field_W = north_W_;
    for (const Region& region : regions_) {
      const double distance_m = std::sqrt(squared_norm(item.X_WS.position() - region.p_W));
      if (distance_m >= region.radius_m) continue;
      const double share = 1 - distance_m / region.radius_m;
      field_W = field_W + share * region.field_W;
    }
    RandomStream random = item.random();
    Vec2 field_S = rotate_back(sincos(item.X_WS.yaw), field_W) + hard_iron_S_;
    field_S.x += noise_share_ * gaussian(random);
    field_S.y += noise_share_ * gaussian(random);
    auto* const values = static_cast<double*>(item.records);
    // The field points north: where north is in the sensor frame is the heading, reversed.
    values[0] = -atan2(field_S.y, field_S.x);
    values[1] = std::sqrt(squared_norm(field_S));
    item.header->count = 2;
  }

 private:
  Status read_regions(std::span<const double> numbers) {
    if (numbers.size() % kNumbersPerRegion != 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "`disturbed` has {} numbers; expected five for each region: x, y, radius, "
                  "strength, direction",
                  numbers.size());
    }
    for (; !numbers.empty(); numbers = numbers.subspan(kNumbersPerRegion)) {
      if (numbers[2] <= 0) {
        return fail(ErrorCode::kInvalidArgument,
                    "`disturbed`: the radius of a region is {}; it must be above 0", numbers[2]);
      }
      const SinCos direction = sincos(deg_to_rad(numbers[4]));
      regions_.push_back({{numbers[0], numbers[1]},
                          numbers[2],
                          {numbers[3] * direction.cos, numbers[3] * direction.sin}});
    }
    return {};
  }

  Vec2 north_W_;
  double noise_share_ = 0;
  Vec2 hard_iron_S_;
  std::vector<Region> regions_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_compass") {
  rave::add_virtual_sensor<rave::VirtualCompass>(
      registry,
      {.name = "virtual_compass",
       .summary = "Heading from magnetic north in rad, and the strength of the field as a "
                  "share of the earth's.",
       .params = rave::kParams});
}
