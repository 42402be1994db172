// SPDX-License-Identifier: Apache-2.0
// What is refused of what monitors ask for, and of what they are told.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"

namespace rave::bus::testing {
namespace {

template <class Message>
std::string judged(const Message& sample) {
  const Status status = validate(sample);
  return status ? "accepted" : status.error().message;
}

TEST(ValidateLook, ASensorBelongsToARobot) {
  std::vector<rave_wire_LookedAt> sensors(1);
  Look look{};
  look.writer = 1;
  borrow(look.sensors, sensors);
  EXPECT_EQ(judged(look), "accepted");
  sensors[0].robot = rave_wire_kNone;
  EXPECT_EQ(judged(look), "sensors.robot is none");
  sensors[0].robot = 0;
  std::vector<std::uint32_t> maps{3, rave_wire_kNone};
  borrow(look.maps, maps);
  EXPECT_EQ(judged(look), "maps is none");
}

TEST(ValidateLook, ReadingsHaveAsManyValuesAsTheySay) {
  std::vector<rave_wire_Reading> entries(1);
  entries[0].rows = 2;
  entries[0].fields = 1;
  std::vector<float> values{1, std::numeric_limits<float>::infinity()};
  Readings readings{};
  readings.writer = 1;
  borrow(readings.entries, entries);
  borrow(readings.values, values);
  EXPECT_EQ(judged(readings), "accepted");
  entries[0].rows = 0xffffffff;
  EXPECT_EQ(judged(readings), "values has 2 entries for readings of 4294967295");
  entries[0].rows = 2;
  entries[0].part = 3;
  EXPECT_EQ(judged(readings), "entries[0].part is 3, above 2");
}

TEST(ValidateLook, EventsAreForLogs) {
  std::vector<rave_wire_RunEvent> events(1);
  put_text(events[0].text, "with b");
  RunEvents sample{};
  sample.writer = 1;
  borrow(sample.events, events);
  EXPECT_EQ(judged(sample), "accepted");
  put_text(events[0].text, "two\nlines");
  EXPECT_EQ(judged(sample), "events.text has control characters");
  put_text(events[0].text, "");
  events[0].time_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(judged(sample).starts_with("events.time_ns is "));
}

TEST(ValidateLook, ReportsAreArraysOfOneLength) {
  std::vector<std::uint32_t> id{3};
  std::vector<double> one{0};
  std::vector<std::uint8_t> flags{1};
  HostState state{};
  state.writer = 1;
  auto& reports = state.reports;
  borrow(reports.id, id);
  for (auto* const column : {&reports.x_m, &reports.y_m, &reports.yaw_rad}) borrow(*column, one);
  borrow(reports.variance_xy_m2, one);
  borrow(reports.variance_yaw_rad2, one);
  EXPECT_EQ(judged(state), "reports.flags has 0 entries for 1 robots");
  borrow(reports.flags, flags);
  EXPECT_EQ(judged(state), "accepted");
  one[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(judged(state).starts_with("reports.x_m[0] is nan"));
}

}  // namespace
}  // namespace rave::bus::testing
