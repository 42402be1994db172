// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "rave/robot/hybrid_sensor.hpp"
#include "rave/sim_testing/engine_fixture.hpp"
#include "rave/sim_testing/given.hpp"

/// Drivers for tests of hybrid sensors in the engine.
namespace rave::sim::testing {

/// A device that the test itself feeds, between two steps, through the port that its parameter
/// names. `live` makes it one by the wall clock, whose samples may come as late as they like.
template <ReadingKind kKind>
class HandFed final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = kKind;
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    const Params params = setup.parameters();
    port_ = static_cast<std::size_t>(static_cast<std::int64_t>(given(params, "port")));
    const auto rays = static_cast<std::uint32_t>(
        std::max<std::int64_t>(1, static_cast<std::int64_t>(given(params, "rays"))));
    for (std::uint32_t i = 0; i < rays; ++i) {
      const double share = rays == 1 ? 0 : double{1} * i / (rays - 1) - 0.5;
      bearings_rad_.push_back(given(params, "fov_rad") * share + given(params, "turned_rad"));
    }
    declaration.capacity = rays;
    if ((given(params, "live") != 0)) declaration.clock = DriverClock::kLive;
    if (kKind != ReadingKind::kRanges) return {};
    declaration.bearings_rad = bearings_rad_.data();
    declaration.range_min_m = 0.1;
    declaration.range_max_m = 10;
    return {};
  }
  Status open(SampleSink& sink) override {
    port(port_) = &sink;
    return {};
  }
  void close() override {}

  static SampleSink*& port(std::size_t number) {
    static std::array<SampleSink*, 4> ports{};
    return ports.at(number);
  }

 private:
  std::size_t port_ = 0;
  std::vector<double> bearings_rad_;
};
using HandFedLaser = HandFed<ReadingKind::kRanges>;
using HandFedPose = HandFed<ReadingKind::kPose>;
using HandFedBumper = HandFed<ReadingKind::kContact>;

/// The smaller of both; throws at the sample `throw_at`.
class Nearest final : public HybridSensor {
 public:
  Status start(const HybridSetup& setup) override {
    throw_at_ = static_cast<std::int64_t>(given(setup.parameters(), "throw_at"));
    return {};
  }
  void fuse(const FuseItem& item) const override {
    if (throw_at_ > 0 && item.real->sequence >= throw_at_) throw std::runtime_error("no rule");
    const auto* const real = static_cast<const float*>(item.real_records);
    const auto* const imagined = static_cast<const float*>(item.imagined_records);
    for (std::uint32_t i = 0; i < item.real->count; ++i) {
      static_cast<float*>(item.result_records)[i] = std::min(real[i], imagined[i]);
    }
    item.result->count = item.real->count;
  }

 private:
  std::int64_t throw_at_ = 0;
};

/// The virtual half as it is.
template <class Record>
class JustVirtual final : public HybridSensor {
 public:
  Status start(const HybridSetup&) override { return {}; }
  void fuse(const FuseItem& item) const override {
    *static_cast<Record*>(item.result_records) = *static_cast<const Record*>(item.imagined_records);
    item.result->count = item.imagined->count;
  }
};

/// What virtual_contact says.
class Bumper final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kContact;
  Status configure(const VirtualSensorSetup&, VirtualDeclaration&) override { return {}; }
  void sample(const WorldView& world, const SampleItem& item) const override {
    static_cast<ContactReading*>(item.records)->touching = world.touch(item.robot).touching ? 1 : 0;
    item.header->count = 1;
  }
};

template <class T>
const HybridSensorOps* hybrid_ops() {
  static constexpr HybridSensorOps kOps = detail::hybrid_sensor_ops<T>();
  return &kOps;
}

/// A sensor of a `Real` and an `Imagined` half that `Fuse` makes one.
template <class Real, class Imagined, class Fuse>
SensorSpec hybrid(Numbers real, Numbers imagined, Numbers fuse = {}) {
  SensorSpec sensor = real_sensor<Real>("eye", real);
  sensor.driver = "fuse";
  sensor.z_m = 0.1;
  sensor.layers = static_cast<LayerMask>(Layer::kVirtualObstacles) |
                  static_cast<LayerMask>(Layer::kSimulatedRobots);
  HybridSpec spec;
  spec.ops = hybrid_ops<Fuse>();
  spec.params = numbers(fuse);
  spec.real_driver = "hand_fed";
  spec.virtual_driver = "imagined";
  spec.virtual_ops = sensor_ops<Imagined>();
  spec.virtual_params = numbers(imagined);
  sensor.hybrid = std::move(spec);
  return sensor;
}

/// A clock that stands where the test puts it.
class PlacedClock final : public RunClock {
 public:
  [[nodiscard]] SimTime now() const noexcept override { return time; }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime) const noexcept override {
    return std::chrono::steady_clock::now();
  }
  SimTime time;
};

inline SimTime at(double t_s) { return {from_seconds(t_s).ns}; }

inline void feed_pose(std::size_t port, double t_s, const Pose2& X_WR) {
  const PoseReading pose{X_WR.x, X_WR.y, X_WR.yaw, 0, 0};
  HandFedPose::port(port)->publish(at(t_s), &pose, 1);
}
inline void feed_ranges(std::size_t port, double t_s, const std::vector<float>& ranges) {
  HandFedLaser::port(port)->publish(at(t_s), ranges.data(),
                                    static_cast<std::uint32_t>(ranges.size()));
}
template <class Device>
void complete(std::size_t port, double t_s) {
  Device::port(port)->complete_up_to(at(t_s));
}

}  // namespace rave::sim::testing
