// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "rave/math/gaussian.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("range_m", "m", 5, 0.001, 1000,
                 "Largest distance to the origin of a sensed robot."),
    number_param("sigma_velocity_mps", "m/s", 0, 0, 100,
                 "Standard deviation of each component of the velocity."),
    bool_param("needs_line_of_sight", false, "Whether bodies between hide a robot."),
    integer_param("max_neighbours", 32, 1, 1024,
                  "Largest number of reported robots, lowest ids first."),
};

/// Limit of robots within range before the filters of layer and visibility. On the stack, because a
/// sample must not allocate.
constexpr std::size_t kCandidates = 1024;

/// Measures the motion of other robots: a sensor without a real counterpart.
class NeighbourVelocity final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kNeighbours;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    range_m_ = params.number("range_m");
    sigma_mps_ = params.number("sigma_velocity_mps");
    needs_line_of_sight_ = params.flag("needs_line_of_sight");
    layers_ = setup.layers;
    declaration.capacity = static_cast<std::uint32_t>(params.integer("max_neighbours"));
    return {};
  }

  void sample(const WorldView& world, const SampleItem& item) const override {
    std::array<RobotId, kCandidates> found;
    const std::size_t there_are = world.robots_within(item.X_WS.position(), range_m_, found);
    const std::size_t candidates = std::min(there_are, found.size());
    auto* const readings = static_cast<NeighbourReading*>(item.records);
    RandomStream random = item.random();
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < candidates && count < item.capacity; ++i) {
      if (senses(world, item, found[i])) {
        readings[count++] = measure(world, item.X_WS, found[i], random);
      }
    }
    item.header->count = count;
  }

 private:
  [[nodiscard]] bool senses(const WorldView& world, const SampleItem& item, RobotId other) const {
    if (other == item.robot) return false;
    const BodyId body = world.body_of(other);
    if (!contains(layers_, world.layer_of(body))) return false;
    return !needs_line_of_sight_ ||
           world.visible(item.X_WS.position(), world.pose(other).position(), item.z_m, layers_,
                         world.body_of(item.robot), body);
  }

  [[nodiscard]] NeighbourReading measure(const WorldView& world, const Pose2& X_WS, RobotId other,
                                         RandomStream& random) const {
    const SinCos heading = sincos(X_WS.yaw);
    const Vec2 p_SN = rotate_back(heading, world.pose(other).position() - X_WS.position());
    const Twist2 v_WN = world.velocity_W(other);
    // Velocity over ground, expressed in the axes of the sensor; the own motion is not subtracted.
    const Vec2 v_WN_S = rotate_back(heading, {v_WN.vx, v_WN.vy});
    NeighbourReading reading;
    reading.robot = other.value();
    reading.range_m = static_cast<float>(std::sqrt(squared_norm(p_SN)));
    reading.bearing_rad = static_cast<float>(atan2(p_SN.y, p_SN.x));
    reading.vx_mps = static_cast<float>(v_WN_S.x + sigma_mps_ * gaussian(random));
    reading.vy_mps = static_cast<float>(v_WN_S.y + sigma_mps_ * gaussian(random));
    return reading;
  }

  double range_m_ = 0;
  double sigma_mps_ = 0;
  bool needs_line_of_sight_ = false;
  LayerMask layers_ = kAllLayers;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("neighbour_velocity") {
  rave::add_virtual_sensor<rave::NeighbourVelocity>(
      registry, {.name = "neighbour_velocity",
                 .summary = "Range, bearing and velocity over ground of the robots nearby.",
                 .params = rave::kParams});
}
