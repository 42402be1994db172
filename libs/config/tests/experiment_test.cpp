// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/experiment_file.hpp"

namespace rave::config {
namespace {

/// An experiment with one more line in its factor, and more lines at its end.
std::string experiment(const std::string& factor, const std::string& more = "") {
  return "name: study\nscenario: room.yaml\nfactors:\n  - name: speed\n    " + factor +
         "\nmetrics:\n  - {name: hits, value: events.contact}\n" + more;
}

std::string error_of(const std::string& text) {
  const auto read = read_experiment_text(text, "e.yaml");
  return read ? "none" : read.error().text();
}

TEST(Experiment, IsWrittenAsItWasRead) {
  const std::string text =
      experiment("key: a.b\n    values: [1, {x: [2, 3]}, far]",
                 "comparisons:\n  - {metric: hits, condition: {speed: far}, against: {speed: 1}, "
                 "expect: less}\nlimits: {wall_s: 5}\nrecordings: extremes\n");
  const auto read = read_experiment_text(text, "e.yaml");
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(read->factors[0].values.size(), 3U);
  const auto again = read_experiment_text(write_experiment(*read), "again.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(*again, *read);
}

TEST(Experiment, ErrorsSayWhereAndWhat) {
  const std::string values = "key: a.b\n    values: [1, 2]";
  EXPECT_EQ(error_of(experiment(values)), "none");
  const auto expect = [](const std::string& text, const std::string& part) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(part), std::string::npos) << error << "\n  expected: " << part;
    EXPECT_TRUE(error.starts_with("e.yaml:")) << error;
  };
  expect(experiment(values, "repetitions: 0\n"), "e.yaml:9:14: `repetitions`: found the number 0");
  expect(experiment(values, "repetition: 3\n"), "did you mean `repetitions`?");
  expect(experiment("values: [1, 2]"), "the factor `speed`: expected a `key` for its values");
  expect(experiment("key: a.b"), "expected exactly one of `values`, `range` and `levels`");
  expect(experiment("key: a.b\n    values: [1, 1]"), "the factor `speed` has the value 1 twice");
  expect(experiment("key: a.b\n    range: {low: 2, high: 1}"),
         "expected more than `low`, 2; found 1");
  expect(experiment(values, "design: latin_hypercube\n"), "expected a `range`");
  expect(experiment(values,
                    "comparisons: [{metric: hit, condition: {speed: 1}, against: {speed: 2}}]\n"),
         "did you mean `hits`?");
  expect(experiment(values,
                    "comparisons: [{metric: hits, condition: {sped: 1}, against: {speed: 2}}]\n"),
         "there is no factor `sped`; did you mean `speed`?");
  expect(experiment(values,
                    "comparisons: [{metric: hits, condition: {speed: 3}, against: {speed: 2}}]\n"),
         "the factor `speed` has no value 3");
  expect(
      "name: study\nscenario: room.yaml\ndesign: zipped\nfactors:\n  - {name: a, key: x, values: "
      "[1]}\n"
      "  - {name: b, key: y, values: [1, 2]}\nmetrics:\n  - {name: hits, value: events.contact}\n",
      "the factor `b` has 2 values and `a` has 1; expected the same number");
}

}  // namespace
}  // namespace rave::config
