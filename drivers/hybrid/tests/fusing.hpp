// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/hybrid_sensor.hpp"

namespace rave::testing {

/// One driver with the parameters that a test gives, called as the engine does.
template <class Driver>
class Fusing {
 public:
  explicit Fusing(std::uint32_t capacity = 1) {
    real_.capacity = capacity;
    imagined_.capacity = capacity;
    real_.kind = Driver::kReading;
    imagined_.kind = Driver::kReading;
    for (const ParamSpec& spec : Driver::kParams) {
      if (spec.type == ParamType::kChoice) {
        params_.add_text(spec.name, spec.default_text);
      } else {
        params_.add_number(spec.name, spec.default_number);
      }
    }
  }
  SensorInfo& real() { return real_; }
  SensorInfo& imagined() { return imagined_; }
  void set(std::string_view name, const char* text) { value(name).text = text; }
  void set(std::string_view name, double number) { value(name).number = number; }

  Status start() {
    HybridSetup setup;
    const auto values = values_.empty() ? params_.values() : std::span<const ParamValue>(values_);
    setup.params = values.data();
    setup.param_count = values.size();
    setup.real = &real_;
    setup.imagined = &imagined_;
    return driver_.start(setup);
  }

  template <class Record>
  std::vector<Record> fuse(const std::vector<Record>& real, const std::vector<Record>& imagined) {
    SampleHeader real_header{0, 1, static_cast<std::uint32_t>(real.size()), 1, 0};
    SampleHeader imagined_header{0, 1, static_cast<std::uint32_t>(imagined.size()), 1, 0};
    SampleHeader result;
    std::vector<Record> records(real_.capacity);
    driver_.fuse(
        {&real_header, real.data(), &imagined_header, imagined.data(), &result, records.data()});
    EXPECT_LE(result.count, real_.capacity);
    records.resize(result.count);
    return records;
  }

 private:
  ParamValue& value(std::string_view name) {
    if (values_.empty()) values_.assign(params_.values().begin(), params_.values().end());
    for (ParamValue& value : values_) {
      if (value.name == name) return value;
    }
    ADD_FAILURE() << "no parameter " << name;
    return values_.front();
  }

  Driver driver_;
  plugin::ParamSet params_;
  std::vector<ParamValue> values_;
  SensorInfo real_;
  SensorInfo imagined_;
};

}  // namespace rave::testing
