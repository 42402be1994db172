// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/sim/virtual_sensor.hpp"

/// Entry function of the driver that is compiled into the test.
extern "C" void rave_register_plugin(rave::RegistrySink* registry);

namespace rave::testing {

/// A parameter with a value other than its default.
struct Given {
  std::string name;
  double number = 0;
  std::vector<double> list = {};
};

/// Records what the plug-in registers.
struct Registrations final : RegistrySink {
  void add(const DriverInfo& info, const void* ops) override {
    infos.push_back(info);
    tables.push_back(ops);
  }
  std::vector<DriverInfo> infos;
  std::vector<const void*> tables;
};

/// The only virtual sensor of a plug-in, called through its registered function table like in the
/// engine. Other parameters have their defaults.
class SensorUnderTest {
 public:
  explicit SensorUnderTest(std::vector<Given> given = {}, LayerMask layers = kAllLayers)
      : given_(std::move(given)) {
    Registrations registered;
    rave_register_plugin(&registered);
    if (registered.infos.size() != 1) throw std::logic_error("one driver was expected");
    info = registered.infos[0];
    ops_ = static_cast<const VirtualSensorOps*>(registered.tables[0]);
    fill_params();
    memory_ = ::operator new(ops_->instance.size, std::align_val_t{ops_->instance.alignment});
    constructed_ = ops_->instance.construct(memory_, &error_) == 0;
    VirtualSensorSetup setup;
    setup.params = values_.data();
    setup.param_count = values_.size();
    setup.layers = layers;
    layers_ = layers;
    configured = constructed_ && ops_->configure(memory_, &setup, &declaration, &error_) == 0;
    state_.resize(ops_->state_size / sizeof(std::max_align_t) + 1);
    reset();
  }
  SensorUnderTest(const SensorUnderTest&) = delete;
  SensorUnderTest& operator=(const SensorUnderTest&) = delete;
  ~SensorUnderTest() {
    if (constructed_) ops_->instance.destroy(memory_);
    ::operator delete(memory_, std::align_val_t{ops_->instance.alignment});
  }

  /// One sample of a sensor without a fan.
  template <class Record>
  std::vector<Record> sample(const WorldView& world, SampleItem item) {
    std::vector<Record> records(declaration.capacity);
    SampleHeader header;
    header.count = ~0U;
    item.capacity = declaration.capacity;
    item.header = &header;
    item.records = records.data();
    item.state = state_.data();
    std::uint8_t failed = 0;
    ops_->sample(memory_, &world, &item, 1, &failed, &error_);
    EXPECT_EQ(failed, 0) << error_.text;
    EXPECT_LE(header.count, declaration.capacity) << "the driver must set the count";
    records.resize(std::min(header.count, declaration.capacity));
    return records;
  }

  /// One sample of a sensor with a fan, cast ray by ray as FanQuery specifies.
  [[nodiscard]] std::vector<double> ranges(const WorldView& world, const SampleItem& item) const {
    const FanQuery& fan = declaration.fan;
    std::vector<double> readings;
    for (std::uint32_t first = 0; first < fan.ray_count; first += fan.rays_per_reading) {
      double range_m = std::numeric_limits<double>::infinity();
      for (std::uint32_t i = first; i < first + fan.rays_per_reading; ++i) {
        const RayHit hit =
            world.cast(item.X_WS.position(), item.z_m, item.X_WS.yaw + fan.bearings_rad[i],
                       fan.range_max_m, layers_, world.body_of(item.robot));
        range_m = std::min(range_m, hit.range_m);
      }
      readings.push_back(std::max(range_m, fan.range_min_m));
    }
    return readings;
  }

  /// Clears the state, like a reset of the run.
  void reset() { std::memset(state_.data(), 0, state_.size() * sizeof(std::max_align_t)); }
  [[nodiscard]] std::string error() const { return error_.text; }

  DriverInfo info;
  VirtualDeclaration declaration;
  bool configured = false;

 private:
  void fill_params() {
    for (const ParamSpec& spec : info.param_specs()) {
      values_.push_back({spec.name, spec.default_number, spec.default_text, nullptr, 0});
    }
    for (const Given& given : given_) {
      const auto value = std::find_if(values_.begin(), values_.end(),
                                      [&](const ParamValue& v) { return given.name == v.name; });
      if (value == values_.end()) throw std::logic_error("no parameter " + given.name);
      value->number = given.number;
      value->list = given.list.data();
      value->list_size = given.list.size();
    }
  }

  const VirtualSensorOps* ops_ = nullptr;
  std::vector<Given> given_;
  std::vector<ParamValue> values_;
  std::vector<std::max_align_t> state_;
  void* memory_ = nullptr;
  bool constructed_ = false;
  LayerMask layers_ = kAllLayers;
  ErrorText error_;
};

/// A sample item for a sensor at the robot's origin; set X_WS for another mounting.
inline SampleItem looking_from(RobotId robot, const Pose2& X_WR, double z_m = 0.5) {
  SampleItem item;
  item.robot = robot;
  item.seed = 42;
  item.X_WR = X_WR;
  item.X_WS = X_WR;
  item.z_m = z_m;
  return item;
}

/// Mean and standard deviation of many draws. Expectations allow five standard errors, which a
/// correct driver exceeds once in a million runs.
class Statistics {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double mean() const { return sum_ / count_; }
  [[nodiscard]] double variance() const { return squares_ / count_ - mean() * mean(); }

  void expect_normal(double mean_expected, double sigma_expected) const {
    EXPECT_NEAR(mean(), mean_expected, 5 * sigma_expected / std::sqrt(count_));
    EXPECT_NEAR(std::sqrt(variance()), sigma_expected, 5 * sigma_expected / std::sqrt(2 * count_));
  }

 private:
  double count_ = 0;
  double sum_ = 0;
  double squares_ = 0;
};

}  // namespace rave::testing
