// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/reading_rows.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace rave::onlook {
namespace {

/// In the order of ReadingKind; those behind the last one are empty.
constexpr std::array<std::array<std::string_view, 5>, 9> kFields = {
    {{},
     {"range [m]"},
     {"code", "range [m]", "bearing [rad]"},
     {"x [m]", "y [m]", "yaw [rad]", "variance xy [m²]", "variance yaw [rad²]"},
     {"x [m]", "y [m]", "yaw [rad]", "v [m/s]", "w [rad/s]"},
     {"robot", "range [m]", "bearing [rad]", "vx [m/s]", "vy [m/s]"},
     {"touching", "bearing [rad]"},
     {"v [m/s]", "w [rad/s]"},
     {"value"}}};

template <class Record>
Record record_at(std::span<const std::byte> records, std::size_t index) {
  Record record;
  std::memcpy(&record, records.data() + index * sizeof(Record), sizeof(Record));
  return record;
}

template <class... Number>
void add(std::vector<float>& values, Number... numbers) {
  (values.push_back(static_cast<float>(numbers)), ...);
}

void add_record(ReadingKind kind, std::span<const std::byte> records, std::size_t i,
                std::vector<float>& values) {
  switch (kind) {
    case ReadingKind::kRanges:
      return add(values, record_at<float>(records, i));
    case ReadingKind::kSightings: {
      const auto r = record_at<Sighting>(records, i);
      return add(values, r.code, r.range_m, r.bearing_rad);
    }
    case ReadingKind::kPose: {
      const auto r = record_at<PoseReading>(records, i);
      return add(values, r.x_m, r.y_m, r.yaw_rad, r.variance_xy_m2, r.variance_yaw_rad2);
    }
    case ReadingKind::kOdometry: {
      const auto r = record_at<OdometryReading>(records, i);
      return add(values, r.x_m, r.y_m, r.yaw_rad, r.v_mps, r.w_radps);
    }
    case ReadingKind::kNeighbours: {
      const auto r = record_at<NeighbourReading>(records, i);
      return add(values, r.robot, r.range_m, r.bearing_rad, r.vx_mps, r.vy_mps);
    }
    case ReadingKind::kContact: {
      const auto r = record_at<ContactReading>(records, i);
      return add(values, r.touching, r.bearing_rad);
    }
    case ReadingKind::kVelocity: {
      const auto r = record_at<VelocityReading>(records, i);
      return add(values, r.v_mps, r.w_radps);
    }
    case ReadingKind::kValues:
      return add(values, record_at<double>(records, i));
    case ReadingKind::kNone:
      return;
  }
}

}  // namespace

std::vector<std::string> fields_of(ReadingKind kind) {
  const auto index = static_cast<std::size_t>(kind);
  // A recording of a later version may have kinds that are unknown here.
  if (index >= kFields.size()) return {};
  const auto& fields = kFields[index];
  return {fields.begin(), fields.begin() + field_count(kind)};
}

std::uint32_t field_count(ReadingKind kind) noexcept {
  const auto index = static_cast<std::size_t>(kind);
  if (index >= kFields.size()) return 0;
  const auto& fields = kFields[index];
  return static_cast<std::uint32_t>(std::ranges::find(fields, "") - fields.begin());
}

std::uint32_t add_rows(ReadingKind kind, std::uint32_t count, std::span<const std::byte> records,
                       std::vector<float>& values) {
  const std::size_t size = record_size(kind);
  const std::size_t whole = size == 0 ? 0 : std::min<std::size_t>(count, records.size() / size);
  for (std::size_t i = 0; i < whole; ++i) add_record(kind, records, i, values);
  return static_cast<std::uint32_t>(whole);
}

}  // namespace rave::onlook
