// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/reading_type.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace rave {
namespace {

/// All that have a record.
std::vector<ReadingKind> kinds() {
  std::vector<ReadingKind> all;
  for (std::uint32_t kind = 1; reading_type(ReadingKind{kind}).name != "unknown"; ++kind) {
    all.push_back(ReadingKind{kind});
  }
  return all;
}

TEST(ReadingType, EveryKindIsDescribed) {
  EXPECT_EQ(kinds().size(), static_cast<std::size_t>(ReadingKind::kValues));
  std::set<std::string_view> names;
  for (const ReadingKind kind : kinds()) {
    const ReadingType& type = reading_type(kind);
    EXPECT_TRUE(names.insert(type.name).second) << type.name;
    EXPECT_FALSE(type.record.empty()) << type.name;
    EXPECT_FALSE(type.columns.empty()) << type.name;
  }
}

/// They are the columns of files that users have: a name that changes breaks their scripts.
TEST(ReadingType, ColumnsHaveTheirNames) {
  std::string text;
  for (const ReadingKind kind : kinds()) {
    text += to_string(kind);
    for (const ReadingField& field : reading_type(kind).columns) {
      text += ' ';
      text += field.name;
    }
    text += '\n';
  }
  EXPECT_EQ(text,
            "ranges range_m\n"
            "sightings code range_m bearing_rad\n"
            "pose x_m y_m yaw_rad variance_xy_m2 variance_yaw_rad2\n"
            "odometry x_m y_m yaw_rad v_mps w_radps variance_xy_m2 variance_yaw_rad2\n"
            "neighbours robot range_m bearing_rad vx_mps vy_mps\n"
            "contact touching bearing_rad\n"
            "velocity v_mps w_radps\n"
            "values value\n");
}

/// A member that is in the struct and not in the table would leave a hole.
TEST(ReadingType, FieldsFillTheRecordWithoutGap) {
  for (const ReadingKind kind : kinds()) {
    std::uint32_t at = 0;
    for (const ReadingField& field : reading_type(kind).fields) {
      EXPECT_EQ(field.offset, at) << to_string(kind) << " " << field.name;
      at += size_of(field.format);
    }
    EXPECT_EQ(at, record_size(kind)) << to_string(kind);
  }
}

/// A column says its unit as every name of RAVE does.
TEST(ReadingType, UnitsAreThoseOfTheNames) {
  const std::array<std::pair<std::string_view, std::string_view>, 6> endings = {
      {{"_m", "m"},
       {"_rad", "rad"},
       {"_mps", "m/s"},
       {"_radps", "rad/s"},
       {"_m2", "m²"},
       {"_rad2", "rad²"}}};
  for (const ReadingKind kind : kinds()) {
    for (const ReadingField& field : reading_type(kind).columns) {
      std::string name(field.name);
      for (const auto& [ending, unit] : endings) {
        if (!name.ends_with(ending)) continue;
        EXPECT_EQ(field.unit, unit) << name;
        name.resize(name.size() - ending.size());
        break;
      }
      std::ranges::replace(name, '_', ' ');
      EXPECT_EQ(field.label, name) << "a unit without an ending, or another label";
    }
  }
}

TEST(ReadingType, AVarianceIsAFieldInTheSquareOfTheUnit) {
  std::size_t found = 0;
  for (const ReadingKind kind : kinds()) {
    const auto fields = reading_type(kind).fields;
    for (const ReadingField& field : fields) {
      if (field.variance.empty()) continue;
      ++found;
      const auto variance = std::ranges::find(fields, field.variance, &ReadingField::name);
      ASSERT_NE(variance, fields.end()) << field.name;
      EXPECT_EQ(variance->unit, std::string(field.unit) + "²") << field.name;
    }
  }
  EXPECT_EQ(found, 6U);
}

/// Filters take the numbers of a record as doubles from its start; those of ranges are floats.
TEST(ReadingType, FilteredFieldsAreDoublesAtTheStart) {
  for (const ReadingKind kind : kinds()) {
    std::uint32_t at = 0;
    for (const ReadingField& field : reading_type(kind).fields) {
      if (!field.filtered || kind == ReadingKind::kRanges) continue;
      EXPECT_EQ(field.format, NumberFormat::kFloat64) << field.name;
      EXPECT_EQ(field.offset, at) << field.name;
      at += sizeof(double);
    }
    EXPECT_TRUE(at == 0 || reading_type(kind).shape != ReadingShape::kList) << to_string(kind);
  }
}

TEST(ReadingType, NumbersAreReadFromUnalignedRecords) {
  const Sighting seen{.stamp_ns = 5, .code = -7, .range_m = 1.5F, .bearing_rad = -0.25F};
  std::array<std::byte, sizeof seen + 1> bytes{};
  std::memcpy(bytes.data() + 1, &seen, sizeof seen);
  std::vector<double> numbers;
  for (const ReadingField& field : reading_type(ReadingKind::kSightings).columns) {
    with_number(field, bytes.data() + 1,
                [&](auto number) { numbers.push_back(static_cast<double>(number)); });
  }
  EXPECT_EQ(numbers, (std::vector<double>{-7, 1.5, -0.25}));
}

/// As in a recording of a later version.
TEST(ReadingType, AnUnknownKindHasNoFields) {
  const ReadingType& type = reading_type(ReadingKind{200});
  EXPECT_EQ(type.name, "unknown");
  EXPECT_EQ(type.record_bytes, 0U);
  EXPECT_TRUE(type.columns.empty());
}

}  // namespace
}  // namespace rave
