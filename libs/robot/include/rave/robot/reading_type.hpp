// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "rave/robot/reading.hpp"

namespace rave {

/// How a number is stored in a record, little endian.
enum class NumberFormat : std::uint8_t { kInt32, kUint32, kInt64, kFloat32, kFloat64 };

/// Such as `float64`.
[[nodiscard]] std::string_view to_string(NumberFormat format) noexcept;
/// Bytes of a number in a record.
[[nodiscard]] std::uint32_t size_of(NumberFormat format) noexcept;

/// What the noise of a NoiseSpec does to a number.
enum class NoiseTerm : std::uint8_t {
  kNone,
  kCoordinate,  ///< Length: x or y.
  kDistance,    ///< Length that stays at least 0; no return stays no return.
  kAngle,       ///< Wrapped.
  kVelocity,
};

/// One number of a record.
struct ReadingField {
  std::string_view name;   ///< That of the member, a column of `rave export`: `x_m`.
  std::string_view label;  ///< For people, without the unit: `x`.
  std::string_view unit;   ///< `m`, `rad²`; empty: none, or known to the driver alone.
  NumberFormat format = NumberFormat::kFloat64;
  std::uint32_t offset = 0;  ///< In the record, in bytes.
  NoiseTerm noise = NoiseTerm::kNone;
  bool filtered = false;  ///< Whether filters smooth it.
  /// Name of the field with its variance, which grows by that of the noise; empty: none.
  std::string_view variance{};
};

/// How many records a sample has.
enum class ReadingShape : std::uint8_t {
  kState,   ///< One.
  kSeries,  ///< A fixed number that belongs together, as the rays of a scan: a table has one row.
  kList,    ///< One for each thing that is seen: the number varies, and each may be missed.
};

/// What is known of a kind of readings. Pages, exports, noise, filters and the reference take it
/// from here: a new kind is a struct in reading.hpp and a row in src/reading_table.hpp.
struct ReadingType {
  std::string_view name;    ///< As in messages and `rave describe`.
  std::string_view record;  ///< C++ type of a record.
  ReadingShape shape = ReadingShape::kState;
  std::uint32_t record_bytes = 0;         ///< 0 for kNone.
  std::span<const ReadingField> fields;   ///< The whole record.
  std::span<const ReadingField> columns;  ///< Those of `fields` that people see.
};

/// The type of a kind; of one that is unknown here, as in a recording of a later version, that of
/// kNone with the name `unknown`.
[[nodiscard]] const ReadingType& reading_type(ReadingKind kind) noexcept;

/// Calls `use` with the number of `field` in a record, as std::int32_t, std::uint32_t,
/// std::int64_t, float or double. `record` need not be aligned.
template <class Use>
void with_number(const ReadingField& field, const std::byte* record, Use use) {
  const auto read = [&]<class Number>(Number number) {
    std::memcpy(&number, record + field.offset, sizeof number);
    use(number);
  };
  switch (field.format) {
    case NumberFormat::kInt32:
      return read(std::int32_t{});
    case NumberFormat::kUint32:
      return read(std::uint32_t{});
    case NumberFormat::kInt64:
      return read(std::int64_t{});
    case NumberFormat::kFloat32:
      return read(float{});
    case NumberFormat::kFloat64:
      return read(double{});
  }
}

}  // namespace rave
