// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rave/math/transform.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr std::size_t kNumbersPerCharger = 4;
constexpr double kJoulesPerWattHour = 3600;

constexpr ParamSpec kParams[] = {
    number_param("capacity_wh", "Wh", 20, 0.0001, 1e6, "Energy of the full battery."),
    number_param("charge_start", "", 1, 0, 1, "Charge at the start, as a share of the capacity."),
    number_param("idle_w", "W", 2, 0, 1e6, "Power of the computer and the sensors."),
    number_param("drive_w_per_mps", "W s/m", 20, 0, 1e6, "Power of driving, per speed."),
    number_param("turn_w_per_radps", "W s/rad", 2, 0, 1e6, "Power of turning, per turning rate."),
    number_param("full_v", "V", 12.6, 0.1, 1000, "Voltage of the full battery without load."),
    number_param("empty_v", "V", 10.5, 0.01, 1000, "Voltage of the empty battery without load."),
    number_param("resistance_ohm", "ohm", 0.1, 0, 1000,
                 "Resistance inside the battery, which lowers the voltage under load."),
    numbers_param("chargers", "", -1e6, 1e6,
                  "Places where it is charged, four numbers each: x and y of the middle in m, "
                  "radius in m, power in W."),
};

/// A circle in which the battery is charged.
struct Charger {
  Vec2 p_W;
  double radius_m = 0;
  double power_w = 0;
};

/// A battery that time and motion drain. Six values as of `create_battery` and `ros2_battery`:
/// charge 0 to 1, V, A (negative: discharging), Ah, Ah of capacity, degrees Celsius.
class VirtualBattery final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  struct State {
    bool started = false;
    Pose2 X_WR;  ///< At the last sample.
    double charge_j = 0;
  };

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "empty_v", "full_v"));
    capacity_j_ = kJoulesPerWattHour * params.number("capacity_wh");
    start_j_ = capacity_j_ * params.number("charge_start");
    idle_w_ = params.number("idle_w");
    per_metre_j_ = params.number("drive_w_per_mps");
    per_radian_j_ = params.number("turn_w_per_radps");
    full_v_ = params.number("full_v");
    empty_v_ = params.number("empty_v");
    resistance_ohm_ = params.number("resistance_ohm");
    declaration.capacity = kValues;
    return read_chargers(params.numbers("chargers"));
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    State& state = *static_cast<State*>(item.state);
    if (!state.started) {
      state.started = true;
      state.X_WR = item.X_WR;
      state.charge_j = start_j_;
    }
    const Twist2 moved = twist_between(state.X_WR, item.X_WR, 1.0);
    const double way_m = std::sqrt(moved.vx * moved.vx + moved.vy * moved.vy);
    const double used_j =
        idle_w_ * item.elapsed_s + per_metre_j_ * way_m + per_radian_j_ * std::abs(moved.wz);
    const double charged_w = charging_w(item.X_WR.position());
    const double load_w = item.elapsed_s > 0 ? used_j / item.elapsed_s : idle_w_;
    state.charge_j =
        std::clamp(state.charge_j - used_j + charged_w * item.elapsed_s, 0.0, capacity_j_);
    state.X_WR = item.X_WR;
    report(state.charge_j, charged_w - load_w, item);
  }

 private:
  static constexpr std::uint32_t kValues = 6;

  /// `power_w`: into the battery.
  void report(double charge_j, double power_w, const SampleItem& item) const {
    const double share = charge_j / capacity_j_;
    const double open_v = empty_v_ + share * (full_v_ - empty_v_);
    const double current_a = power_w / open_v;
    const double capacity_ah = capacity_j_ / kJoulesPerWattHour / (0.5 * (empty_v_ + full_v_));
    auto* const values = static_cast<double*>(item.records);
    values[0] = share;
    values[1] = std::max(0.0, open_v + resistance_ohm_ * current_a);
    values[2] = current_a;
    values[3] = share * capacity_ah;
    values[4] = capacity_ah;
    values[5] = std::numeric_limits<double>::quiet_NaN();
    item.header->count = kValues;
  }

  [[nodiscard]] double charging_w(Vec2 p_W) const {
    double power_w = 0;
    for (const Charger& charger : chargers_) {
      if (squared_norm(p_W - charger.p_W) < charger.radius_m * charger.radius_m) {
        power_w += charger.power_w;
      }
    }
    return power_w;
  }

  Status read_chargers(std::span<const double> numbers) {
    if (numbers.size() % kNumbersPerCharger != 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "`chargers` has {} numbers; expected four for each place: x, y, radius, power",
                  numbers.size());
    }
    for (; !numbers.empty(); numbers = numbers.subspan(kNumbersPerCharger)) {
      chargers_.push_back({{numbers[0], numbers[1]}, numbers[2], numbers[3]});
    }
    return {};
  }

  double capacity_j_ = 1;
  double start_j_ = 0;
  double idle_w_ = 0;
  double per_metre_j_ = 0;   ///< Power per speed is energy per way.
  double per_radian_j_ = 0;  ///< And per turn.
  double full_v_ = 1;
  double empty_v_ = 0;
  double resistance_ohm_ = 0;
  std::vector<Charger> chargers_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_battery") {
  rave::add_virtual_sensor<rave::VirtualBattery>(
      registry,
      {.name = "virtual_battery",
       .summary = "Charge, voltage and current of a battery that time and motion drain; six "
                  "values as of create_battery.",
       .params = rave::kParams});
}
