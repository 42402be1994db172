// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rave/math/gaussian.hpp"
#include "rave/math/transform.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    required(numbers_param("codes", "", 0, 2147483647,
                           "Barcodes of the robots and obstacles that answer, in the order of the "
                           "values.")),
    number_param("range_min_m", "m", 0.05, 0, 1000, "Smallest distance that it can measure."),
    number_param("range_max_m", "m", 3, 0, 1000, "Largest distance at which an answer is heard."),
    bool_param("occlusion", true, "Whether bodies between swallow the sound."),
    number_param("noise_m", "m", 0.005, 0, 100, "Standard deviation of a distance."),
    number_param("noise_share", "", 0, 0, 1,
                 "Further standard deviation, as a share of the distance."),
    number_param("sound_error", "", 0, -0.5, 0.5,
                 "By how much the speed of sound that the robot assumes is too high, as a share; "
                 "0.018 for 10 degrees too warm."),
    number_param("miss_probability", "", 0, 0, 1, "Probability that an answer is not heard."),
};

/// Distances to named beacons by the time that ultrasound takes after a radio call.
class VirtualBeaconRanges final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    for (const double code : params.numbers("codes")) {
      if (code != std::floor(code)) {
        return fail(ErrorCode::kInvalidArgument, "`codes` has {}; expected whole numbers", code);
      }
      codes_.push_back(static_cast<std::int32_t>(code));
    }
    if (codes_.empty()) {
      return fail(ErrorCode::kInvalidArgument, "`codes` is empty; expected at least one barcode");
    }
    range_min_m_ = params.number("range_min_m");
    range_max_m_ = params.number("range_max_m");
    occlusion_ = params.flag("occlusion");
    noise_m_ = params.number("noise_m");
    noise_share_ = params.number("noise_share");
    scale_ = 1 + params.number("sound_error");
    miss_probability_ = params.number("miss_probability");
    layers_ = setup.layers;
    declaration.capacity = static_cast<std::uint32_t>(codes_.size());
    return {};
  }

  void sample(const WorldView& world, const SampleItem& item) const override {
    auto* const ranges = static_cast<double*>(item.records);
    RandomStream random = item.random();
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      // Drawn for each beacon, heard or not, so that one does not change the errors of others.
      const double error = gaussian(random);
      const bool missed = random.uniform() < miss_probability_;
      const double range_m = missed ? kNone_m : heard_m(world, item, codes_[i]);
      ranges[i] = range_m;
      if (range_m == kNone_m) continue;
      const double sigma_m =
          std::sqrt(noise_m_ * noise_m_ + noise_share_ * noise_share_ * range_m * range_m);
      ranges[i] = std::max(range_min_m_, scale_ * range_m + sigma_m * error);
    }
    item.header->count = static_cast<std::uint32_t>(codes_.size());
  }

 private:
  static constexpr double kNone_m = std::numeric_limits<double>::infinity();

  /// The distance to the nearest body with this code that is heard.
  [[nodiscard]] double heard_m(const WorldView& world, const SampleItem& item,
                               std::int32_t code) const {
    double nearest_m = kNone_m;
    for (const Landmark& landmark : world.landmarks()) {
      if (landmark.code != code || landmark.robot == item.robot ||
          !contains(layers_, world.layer_of(landmark.body))) {
        continue;
      }
      const double range_m = std::sqrt(squared_norm(landmark.p_WL - item.X_WS.position()));
      if (range_m > range_max_m_ || range_m >= nearest_m) continue;
      const double z_m = std::clamp(item.z_m, landmark.z0_m, landmark.z1_m);
      if (occlusion_ && !world.visible(item.X_WS.position(), landmark.p_WL, z_m, layers_,
                                       world.body_of(item.robot), landmark.body)) {
        continue;
      }
      nearest_m = range_m;
    }
    return nearest_m;
  }

  std::vector<std::int32_t> codes_;
  double range_min_m_ = 0;
  double range_max_m_ = 0;
  bool occlusion_ = true;
  double noise_m_ = 0;
  double noise_share_ = 0;
  double scale_ = 1;
  double miss_probability_ = 0;
  LayerMask layers_ = kAllLayers;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_beacon_ranges") {
  rave::add_virtual_sensor<rave::VirtualBeaconRanges>(
      registry, {.name = "virtual_beacon_ranges",
                 .summary = "Distance in m to each of the named beacons, by the time of flight of "
                            "ultrasound; infinity for one that is not heard.",
                 .params = rave::kParams});
}
