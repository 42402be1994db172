// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/gaussian.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("gyro_noise_radps", "rad/s", 0.002, 0, 10,
                 "Standard deviation of the noise of one turning rate."),
    number_param("gyro_bias_radps", "rad/s", 0.005, 0, 10,
                 "Standard deviation of the bias at the start, different for each robot and seed."),
    number_param("gyro_walk_radps", "rad/s", 0.0002, 0, 10,
                 "Standard deviation of what the bias changes in one second, a random walk."),
    number_param("gyro_max_radps", "rad/s", 8.7, 0.001, 1000, "Largest rate that it can show."),
    number_param("accel_noise_mps2", "m/s²", 0.02, 0, 100,
                 "Standard deviation of the noise of one acceleration."),
    number_param("accel_bias_mps2", "m/s²", 0.05, 0, 100,
                 "Standard deviation of the bias of each axis at the start."),
    number_param("accel_walk_mps2", "m/s²", 0.001, 0, 100,
                 "Standard deviation of what the bias of an axis changes in one second."),
    number_param("accel_max_mps2", "m/s²", 39.2, 0.001, 10000,
                 "Largest acceleration that it can show."),
};

/// The errors of one kind of axis.
struct Errors {
  double noise = 0;
  double bias = 0;
  double walk = 0;
  double largest = 0;

  [[nodiscard]] double first_bias(RandomStream& random) const { return bias * gaussian(random); }
  void drift(double& of_axis, double elapsed_s, RandomStream& random) const {
    of_axis += walk * std::sqrt(elapsed_s) * gaussian(random);
  }
  [[nodiscard]] double show(double value, double bias_now, RandomStream& random) const {
    return std::clamp(value + bias_now + noise * gaussian(random), -largest, largest);
  }
};

/// The ten values of `ros2_imu`: orientation x, y, z, w; rate of turn about x, y, z; acceleration
/// along them with gravity. It measures a rate and two accelerations, each with a bias that
/// wanders.
class VirtualImu final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  struct State {
    bool started = false;
    double yaw_rad = 0;  ///< Of the sensor, at the last sample.
    Vec2 v_WS_W;         ///< Velocity of the sensor at the last sample.
    double bias_x = 0;
    double bias_y = 0;
    double bias_gyro = 0;
  };

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    gyro_ = {params.number("gyro_noise_radps"), params.number("gyro_bias_radps"),
             params.number("gyro_walk_radps"), params.number("gyro_max_radps")};
    accel_ = {params.number("accel_noise_mps2"), params.number("accel_bias_mps2"),
              params.number("accel_walk_mps2"), params.number("accel_max_mps2")};
    declaration.capacity = kValues;
    return {};
  }

  void sample(const WorldView& world, const SampleItem& item) const override {
    State& state = *static_cast<State*>(item.state);
    RandomStream random = item.random();
    const Vec2 v_WS_W = velocity(world, item);
    if (!state.started) {
      state = {true,
               item.X_WS.yaw,
               v_WS_W,
               accel_.first_bias(random),
               accel_.first_bias(random),
               gyro_.first_bias(random)};
    }
    accel_.drift(state.bias_x, item.elapsed_s, random);
    accel_.drift(state.bias_y, item.elapsed_s, random);
    gyro_.drift(state.bias_gyro, item.elapsed_s, random);
    // Means over the time since the last sample, so that their sum is the change of speed and yaw.
    const double per_second = item.elapsed_s > 0 ? 1 / item.elapsed_s : 0;
    const double turned_rad = wrap_angle(item.X_WS.yaw - state.yaw_rad);
    const Vec2 a_S =
        rotate(-(state.yaw_rad + 0.5 * turned_rad), per_second * (v_WS_W - state.v_WS_W));
    auto* const values = static_cast<double*>(item.records);
    std::fill_n(values, kValues, std::numeric_limits<double>::quiet_NaN());
    values[kRateX] = values[kRateX + 1] = 0;
    values[kRateX + 2] = gyro_.show(turned_rad * per_second, state.bias_gyro, random);
    values[kAccelX] = accel_.show(a_S.x, state.bias_x, random);
    values[kAccelX + 1] = accel_.show(a_S.y, state.bias_y, random);
    values[kAccelX + 2] = kGravity_mps2;
    item.header->count = kValues;
    state.yaw_rad = item.X_WS.yaw;
    state.v_WS_W = v_WS_W;
  }

 private:
  static constexpr std::uint32_t kValues = 10;
  static constexpr std::uint32_t kRateX = 4;
  static constexpr std::uint32_t kAccelX = 7;
  static constexpr double kGravity_mps2 = 9.80665;

  /// Of the point where the sensor is: it also moves when the robot turns.
  static Vec2 velocity(const WorldView& world, const SampleItem& item) {
    const Twist2 robot = world.velocity_W(item.robot);
    const Vec2 arm_W = item.X_WS.position() - item.X_WR.position();
    return {robot.vx - robot.wz * arm_W.y, robot.vy + robot.wz * arm_W.x};
  }

  Errors gyro_;
  Errors accel_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_imu") {
  rave::add_virtual_sensor<rave::VirtualImu>(
      registry,
      {.name = "virtual_imu",
       .summary = "Turning rate and accelerations of a robot on a level floor, with biases that "
                  "wander; ten values as of ros2_imu.",
       .params = rave::kParams});
}
