// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_sensors.hpp"

#include <algorithm>

#include "rave/line/host_clock.hpp"
#include "rave/math/scalar.hpp"

namespace rave::oi {
namespace {

/// The halves of the bumper meet in front; their centres are at 45 degrees.
constexpr float kBumperBearing_rad = static_cast<float>(kPi / 4);

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Status DeviceSensor::configure(const HardwareSetup& setup, HardwareDeclaration& declaration) {
  device_ = static_cast<CreateDevice*>(setup.device);
  if (device_ == nullptr) return fail(ErrorCode::kState, "has no `device`");
  declaration.clock = DriverClock::kLive;
  // All sensors of the robot come with each frame of the stream.
  declaration.period_s = kStreamPeriod_s;
  return prepare(setup.parameters(), declaration);
}

Status DeviceSensor::open(SampleSink& sink) {
  if (device_ == nullptr) return fail(ErrorCode::kState, "opened before it was configured");
  if (sink_ != nullptr) return fail(ErrorCode::kState, "opened twice; close it first");
  sink_ = &sink;
  last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
  begin();
  // Last, because frames may arrive before attach() returns.
  device_->attach(*this);
  return {};
}

void DeviceSensor::close() {
  if (sink_ == nullptr) return;
  device_->detach(*this);
  sink_ = nullptr;
}

void DeviceSensor::publish(double moment_s, const void* records, std::uint32_t count) {
  // Device times never decrease, but their conversion to the run's clock rounds.
  const SimTime stamp{std::max(line::run_stamp(*sink_, moment_s).ns, last_stamp_ns_)};
  last_stamp_ns_ = stamp.ns;
  (void)sink_->publish(stamp, records, count);
}

void DeviceSensor::gone(std::string_view why) { sink_->fail(why.data(), why.size()); }

void DeviceSensor::back() { sink_->recover(); }

Status CreateOdometry::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  const Geometry& geometry = device().geometry();
  options_.wheel_base_m = geometry.wheel_base_m;
  options_.counts_per_m = geometry.counts_per_m;
  options_.max_wheel_mps = geometry.max_wheel_mps;
  options_.noise_per_metre_m = params.number("noise_per_metre_m");
  options_.window_s = params.number("velocity_window_s");
  device().want(std::array{Packet::kLeftCounts, Packet::kRightCounts});
  return {};
}

void CreateOdometry::begin() {
  odometer_ = WheelOdometer(options_);
  disbelieved_ = 0;
  restarts_ = 0;
}

void CreateOdometry::take(const OiState& state, double moment_s) {
  const bool believed = odometer_.step(state.left_counts, state.right_counts, moment_s);
  disbelieved_ = odometer_.disbelieved();
  restarts_ = odometer_.restarts();
  if (!believed) return;
  const OdometryReading reading = odometer_.reading();
  publish(moment_s, &reading, 1);
}

std::string CreateOdometry::report() const {
  return fmt::format(R"({{"disbelieved":{},"restarts":{}}})", disbelieved_.load(),
                     restarts_.load());
}

Status CreateBumper::prepare(const Params& /*params*/, HardwareDeclaration& /*declaration*/) {
  device().want(std::array{Packet::kBumpsAndDrops});
  return {};
}

void CreateBumper::take(const OiState& state, double moment_s) {
  ContactReading reading;
  reading.touching = state.bump_left || state.bump_right ? 1 : 0;
  if (state.bump_left != state.bump_right) {
    reading.bearing_rad = state.bump_left ? kBumperBearing_rad : -kBumperBearing_rad;
  }
  publish(moment_s, &reading, 1);
}

Status CreateCliff::prepare(const Params& /*params*/, HardwareDeclaration& declaration) {
  declaration.capacity = 6;
  device().want(std::array{Packet::kCliffLeft, Packet::kCliffFrontLeft, Packet::kCliffFrontRight,
                           Packet::kCliffRight, Packet::kBumpsAndDrops});
  return {};
}

void CreateCliff::take(const OiState& state, double moment_s) {
  const auto number = [](bool yes) { return yes ? 1.0 : 0.0; };
  const std::array values{number(state.cliff_left),        number(state.cliff_front_left),
                          number(state.cliff_front_right), number(state.cliff_right),
                          number(state.drop_left),         number(state.drop_right)};
  publish(moment_s, values.data(), values.size());
}

Status CreateBattery::prepare(const Params& params, HardwareDeclaration& declaration) {
  declaration.capacity = 6;
  period_s_ = params.number("period_s");
  declaration.period_s = period_s_;
  device().want(std::array{Packet::kChargingState, Packet::kVoltage, Packet::kCurrent,
                           Packet::kTemperature, Packet::kBatteryCharge, Packet::kBatteryCapacity});
  return {};
}

void CreateBattery::begin() { due_s_ = 0; }

void CreateBattery::take(const OiState& state, double moment_s) {
  // The device sends the battery with each frame, because a stream has one list of packets. Its
  // values change slowly.
  if (moment_s < due_s_) return;
  due_s_ = moment_s + period_s_;
  const double charge_ah = state.charge_mah * 1e-3;
  const double capacity_ah = state.capacity_mah * 1e-3;
  // A capacity of 0 is one that the robot does not know.
  const std::array values{capacity_ah > 0 ? charge_ah / capacity_ah : kUnknown,
                          state.voltage_mv * 1e-3,
                          state.current_ma * 1e-3,
                          charge_ah,
                          capacity_ah,
                          static_cast<double>(state.temperature_c)};
  publish(moment_s, values.data(), values.size());
}

}  // namespace rave::oi
