// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/metric.hpp"

#include <gtest/gtest.h>

#include "rave/codec/json_input.hpp"

namespace rave::experiment {
namespace {

codec::RawNode result() {
  return *codec::parse_json(R"({"capture": {"captured_at_s": null, "holds": true},
      "events": {"contact": 3}, "lateness": null,
      "robots": [{"name": "anna", "way_m": 1.5, "final_pose": {"x_m": -2}}, {"name": "bert"}],
      "devices": [{"robot": "anna", "count": 7}], "scenario": "room"})");
}

TEST(Metric, FindsNumbersByNameAndPlace) {
  EXPECT_EQ(number_at(result(), "events.contact")->value(), 3);
  EXPECT_EQ(number_at(result(), "robots.anna.final_pose.x_m")->value(), -2);
  EXPECT_EQ(number_at(result(), "robots.0.way_m")->value(), 1.5);
  EXPECT_EQ(number_at(result(), "devices.anna.count")->value(), 7);
  EXPECT_EQ(number_at(result(), "capture.holds")->value(), 1);
}

TEST(Metric, OfNullIsUnknown) {
  ASSERT_TRUE(number_at(result(), "capture.captured_at_s").has_value());
  EXPECT_FALSE(number_at(result(), "capture.captured_at_s")->has_value());
  EXPECT_FALSE(number_at(result(), "lateness.missed")->has_value());
}

TEST(Metric, ThatIsNotThereIsAnErrorOrItsDefault) {
  EXPECT_EQ(number_at(result(), "robots.ana.way_m").error().message,
            "result.json has no `ana` of `robots.ana.way_m`; did you mean `anna`?");
  EXPECT_EQ(number_at(result(), "scenario").error().message,
            "`scenario` of result.json: found the text \"room\", expected a number");
  config::MetricFile metric;
  metric.value = codec::Located<std::string>("events.pinned");
  EXPECT_FALSE(value_of(metric, result()).has_value());
  metric.absent = 0;
  EXPECT_EQ(value_of(metric, result())->value(), 0);
}

}  // namespace
}  // namespace rave::experiment
