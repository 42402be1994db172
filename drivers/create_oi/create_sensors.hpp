// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <limits>
#include <string>

#include "create_oi/create_device.hpp"
#include "create_oi/wheel_odometer.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::oi {

/// The common part of the sensors of a device: each converts a frame to a sample. The host's thread
/// calls configure(), open() and close(); the device's thread calls take(), gone() and back().
class DeviceSensor : public HardwareSensor, protected FrameListener {
 public:
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override;
  Status open(SampleSink& sink) override;
  void close() override;

 protected:
  /// Reads parameters and adds the packets that the stream must contain. `device()` is set.
  virtual Status prepare(const Params& params, HardwareDeclaration& declaration) = 0;
  virtual void begin() {}
  [[nodiscard]] CreateDevice& device() const { return *device_; }
  /// Publishes records that were true at `moment_s` of the host's clock.
  void publish(double moment_s, const void* records, std::uint32_t count);

  void gone(std::string_view why) override;
  void back() override;

 private:
  CreateDevice* device_ = nullptr;
  SampleSink* sink_ = nullptr;
  std::int64_t last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
};

inline constexpr std::array<ParamSpec, 2> kOdometryParams{
    number_param("noise_per_metre_m", "m", 0.02, 0, 1,
                 "Standard deviation of the travel of one wheel after one metre; it grows with the "
                 "square root of the distance."),
    number_param("velocity_window_s", "s", 0.1, 0.02, 2,
                 "Window of the mean velocity: one count in 15 ms is 0.03 m/s."),
};

class CreateOdometry final : public DeviceSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kOdometry;
  [[nodiscard]] std::string report() const override;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void begin() override;
  void take(const OiState& state, double moment_s) override;

  WheelOdometer::Options options_;
  WheelOdometer odometer_{WheelOdometer::Options{}};
  std::atomic<std::uint64_t> disbelieved_{0};
  std::atomic<std::uint64_t> restarts_{0};
};

class CreateBumper final : public DeviceSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kContact;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void take(const OiState& state, double moment_s) override;
};

/// Six values of 0 or 1: cliff left, front left, front right, right; wheel drop left, right.
class CreateCliff final : public DeviceSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void take(const OiState& state, double moment_s) override;
};

inline constexpr std::array<ParamSpec, 1> kBatteryParams{
    number_param("period_s", "s", 1, 0.015, 600, "Time between two samples."),
};

/// Six values: charge (0 to 1; NaN: unknown capacity), voltage V, current A (negative:
/// discharging), charge Ah, capacity Ah, temperature in degrees Celsius.
class CreateBattery final : public DeviceSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void begin() override;
  void take(const OiState& state, double moment_s) override;

  double period_s_ = 1;
  double due_s_ = 0;
};

}  // namespace rave::oi
