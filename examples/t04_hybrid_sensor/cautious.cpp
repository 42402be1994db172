// SPDX-License-Identifier: Apache-2.0
// A rule of fusion for ranges: the nearer of the real and the virtual reading, minus a margin.
#include <algorithm>
#include <cmath>
#include <rave/robot/plugin_entry.hpp>

namespace {

class Cautious final : public rave::HybridSensor {
 public:
  static constexpr rave::ReadingKind kReading = rave::ReadingKind::kRanges;

  rave::Status start(const rave::HybridSetup& setup) override {
    if (setup.real->capacity != setup.imagined->capacity) {
      return rave::fail(rave::ErrorCode::kInvalidArgument,
                        "the real half has {} rays, the virtual half {}; expected equal numbers",
                        setup.real->capacity, setup.imagined->capacity);
    }
    margin_m_ = static_cast<float>(setup.parameters().number("margin_m"));
    return {};
  }

  // Both readings are of the same instant: the virtual half was evaluated at the stamp of the real
  // one, from where the robot was then.
  void fuse(const rave::FuseItem& item) const override {
    const auto* const real_m = static_cast<const float*>(item.real_records);
    const auto* const virtual_m = static_cast<const float*>(item.imagined_records);
    auto* const result_m = static_cast<float*>(item.result_records);
    const std::uint32_t count = std::min(item.real->count, item.imagined->count);
    for (std::uint32_t i = 0; i < count; ++i) {
      // fmin: an invalid reading (NaN) of one half leaves that of the other.
      result_m[i] = std::max(std::fmin(real_m[i], virtual_m[i]) - margin_m_, 0.0F);
    }
    item.result->count = count;
  }

 private:
  float margin_m_ = 0;
};

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("margin_m", "m", 0.05, 0, 1, "Subtracted from every range."),
};

}  // namespace

RAVE_PLUGIN("cautious") {
  rave::add_hybrid_sensor<Cautious>(
      registry, {.name = "cautious",
                 .summary = "The nearer of a real and a virtual range, minus a margin.",
                 .params = kParams});
}
