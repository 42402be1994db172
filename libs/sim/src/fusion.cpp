// SPDX-License-Identifier: Apache-2.0
// The parts of a hybrid sensor: a virtual half beside the real one, the noise of each, and the
// driver that makes one reading of both.
#include "fusion.hpp"

#include <algorithm>
#include <cmath>

#include "declared_fan.hpp"
#include "plugin_call.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

/// Rays of the two halves that differ by more do not point the same way.
constexpr double kSameBearing_rad = 1e-6;

Error in_half(std::string_view half, const std::string& driver, Error error) {
  return std::move(error).with_context(fmt::format("{} half (driver `{}`)", half, driver));
}

std::string limits_of(const SensorInfo& info) {
  if (info.bearings_rad == nullptr) return fmt::format("{} rays", info.capacity);
  return fmt::format("{} rays from {:.4f} to {:.4f} deg", info.capacity,
                     rad_to_deg(info.bearings_rad[0]),
                     rad_to_deg(info.bearings_rad[info.capacity - 1]));
}

/// Ranges are fused ray by ray, so the rays of both halves must be the same.
Status check_rays(const HybridSpec& spec, const SensorInfo& real, const SensorInfo& imagined) {
  if (real.bearings_rad == nullptr || imagined.bearings_rad == nullptr) {
    return fail(ErrorCode::kInvalidArgument,
                "the {} half (driver `{}`) does not state the bearings of its rays",
                real.bearings_rad == nullptr ? "real" : "virtual",
                real.bearings_rad == nullptr ? spec.real_driver : spec.virtual_driver);
  }
  std::string difference;
  if (real.capacity == imagined.capacity) {
    for (std::uint32_t i = 0; i < real.capacity && difference.empty(); ++i) {
      // Wrapped, since one driver may count from -180 degrees and the other from 180.
      const double off_rad = wrap_angle(real.bearings_rad[i] - imagined.bearings_rad[i]);
      if (std::abs(off_rad) <= kSameBearing_rad) continue;
      difference =
          fmt::format("; ray {} points to {:.6f} and {:.6f} deg", i + 1,
                      rad_to_deg(real.bearings_rad[i]), rad_to_deg(imagined.bearings_rad[i]));
    }
    if (difference.empty()) return {};
  }
  return fail(ErrorCode::kInvalidArgument,
              "the halves must have the same rays, but the real one (driver `{}`) has {}, the "
              "virtual one (driver `{}`) {}{}",
              spec.real_driver, limits_of(real), spec.virtual_driver, limits_of(imagined),
              difference);
}

Status configure_imagined(const SensorSpec& sensor, const SensorInfo& real, HostServices host,
                          FusionSlots& slots, SensorInfo& imagined) {
  const HybridSpec& spec = *sensor.hybrid;
  RAVE_TRY(slots.imagined.make(spec.virtual_ops->instance, 1));
  auto setup = setup_with<VirtualSensorSetup>(spec.virtual_params, host);
  setup.layers = sensor.layers;
  setup.period_s = real.period_s;
  setup.z_m = sensor.z_m;
  // The virtual driver may take its rays and limits from the real device.
  setup.real_half = &real;
  // What the virtual half does not declare is as in the real one.
  imagined = real;
  imagined.bearings_rad = nullptr;
  RAVE_TRY_ASSIGN(
      const VirtualDeclaration declaration,
      declaration_of(*spec.virtual_ops, slots.imagined.at(0), setup, sensor.kind, imagined));
  slots.capacity = imagined.capacity;
  slots.uses_fan = declaration.uses_fan != 0;
  if (slots.uses_fan) slots.fan = FanTable::make(declaration.fan, sensor.layers);
  if (slots.capacity == 0) return fail(ErrorCode::kPlugin, "declared room for 0 records");
  return {};
}

Result<std::optional<Processing>> noise_of(const NoiseSpec& noise, const SensorSpec& sensor,
                                           const SensorInfo& info, std::string_view half,
                                           const std::string& driver) {
  if (!noise.any()) return std::nullopt;
  ProcessingSpec spec;
  spec.noise = noise;
  auto made = Processing::make(spec, sensor.kind, info.capacity, 0, range_limits_of(info));
  if (!made) return tl::unexpected(in_half(half, driver, std::move(made).error()));
  return *std::move(made);
}

/// Whole words, so that records of every member are aligned.
std::uint32_t stride_of(std::uint32_t capacity, ReadingKind kind) {
  return (capacity * record_size(kind) + 7U) / 8U * 8U;
}

Status start_driver(const HybridSpec& spec, const SensorInfo& real, const SensorInfo& imagined,
                    HostServices host, FusionSlots& slots) {
  RAVE_TRY(slots.driver.make(spec.ops->instance, 1));
  auto setup = setup_with<HybridSetup>(spec.params, host);
  setup.real = &real;
  setup.imagined = &imagined;
  return called(
      [&](ErrorText* error) { return spec.ops->start(slots.driver.at(0), &setup, error); });
}

void allocate(const SensorSpec& sensor, const SensorInfo& real, std::uint32_t members,
              FusionSlots& slots) {
  slots.real_stride = stride_of(real.capacity, sensor.kind);
  slots.imagined_stride = stride_of(slots.capacity, sensor.kind);
  slots.real_headers.resize(members);
  slots.real_records.resize(std::size_t{slots.real_stride} * members);
  slots.imagined_headers.resize(members);
  slots.imagined_records.resize(std::size_t{slots.imagined_stride} * members);
  if (slots.uses_fan) slots.bodies.resize(std::size_t{slots.capacity} * members);
  slots.state.resize(sensor.hybrid->virtual_ops->state_size * members);
  slots.failed.resize(members);
  slots.withheld.resize(members);
  slots.too_late.resize(members);
  slots.last_stamp.resize(members);
  slots.clear();
}

}  // namespace

SensorSpec virtual_half_of(SensorSpec sensor) {
  if (!sensor.hybrid) return sensor;
  sensor.hardware_ops = nullptr;
  sensor.virtual_ops = sensor.hybrid->virtual_ops;
  sensor.params = std::move(sensor.hybrid->virtual_params);
  sensor.hybrid.reset();
  return sensor;
}

Result<std::unique_ptr<FusionSlots>> FusionSlots::make(const SensorSpec& spec,
                                                       const SensorInfo& real,
                                                       std::uint32_t members, HostServices host) {
  const HybridSpec& hybrid = *spec.hybrid;
  auto slots = std::make_unique<FusionSlots>();
  SensorInfo imagined;
  // The order of dependence: the virtual half needs the real one, the fusion needs both.
  if (auto made = configure_imagined(spec, real, host, *slots, imagined); !made) {
    return tl::unexpected(in_half("virtual", hybrid.virtual_driver, std::move(made).error()));
  }
  if (spec.kind == ReadingKind::kRanges) RAVE_TRY(check_rays(hybrid, real, imagined));
  RAVE_TRY_ASSIGN(slots->real_noise,
                  noise_of(hybrid.real_noise, spec, real, "real", hybrid.real_driver));
  RAVE_TRY_ASSIGN(slots->imagined_noise,
                  noise_of(hybrid.virtual_noise, spec, imagined, "virtual", hybrid.virtual_driver));
  RAVE_TRY(start_driver(hybrid, real, imagined, host, *slots));
  allocate(spec, real, members, *slots);
  return slots;
}

void FusionSlots::clear() {
  std::fill(real_headers.begin(), real_headers.end(), SampleHeader{});
  std::fill(real_records.begin(), real_records.end(), std::byte{});
  std::fill(imagined_headers.begin(), imagined_headers.end(), SampleHeader{});
  std::fill(imagined_records.begin(), imagined_records.end(), std::byte{});
  std::fill(bodies.begin(), bodies.end(), BodyId::kNone);
  std::fill(state.begin(), state.end(), std::byte{});
  std::fill(failed.begin(), failed.end(), std::uint8_t{0});
  std::fill(withheld.begin(), withheld.end(), 0U);
  std::fill(too_late.begin(), too_late.end(), std::uint64_t{0});
  std::fill(last_stamp.begin(), last_stamp.end(), std::int64_t{-1});
}

SensorParts FusionSlots::parts_of(std::size_t member) const noexcept {
  SensorParts parts;
  parts.real = &real_headers[member];
  parts.real_records = real_records.data() + std::size_t{real_stride} * member;
  parts.imagined = &imagined_headers[member];
  parts.imagined_records = imagined_records.data() + std::size_t{imagined_stride} * member;
  if (uses_fan) {
    parts.bodies = std::span(bodies).subspan(std::size_t{capacity} * member, capacity);
  }
  return parts;
}

}  // namespace rave::sim
