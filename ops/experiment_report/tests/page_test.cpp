// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/page.hpp"

#include <gtest/gtest.h>

#include "rave/experiment_report/summary.hpp"
#include "sample_experiment.hpp"

namespace rave::experiment {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Analysis analysis_of(const std::string& factors) {
  Plan plan = sample_plan(factors, 5, "");
  const RunRows rows = sample_rows(plan, [](std::size_t c, std::uint64_t seed) {
    if (c == 1 && seed == 2) return std::vector<std::optional<double>>{};
    return std::vector<std::optional<double>>{static_cast<double>(c + seed), 3};
  });
  return *analyse(std::move(plan), rows);
}

const std::string kOne = "{name: speed, unit: m/s, key: a.speed, values: [1, 2, 3]}";

TEST(ReportPage, AsksForNothingElse) {
  const std::string page = report_page(analysis_of(kOne), "1.0");
  for (const char* const word :
       {"http:", "https:", "src=", "<script", "<link", "url(", "@import"}) {
    EXPECT_FALSE(has(page, word)) << word;
  }
  EXPECT_TRUE(has(page, "prefers-color-scheme:dark"));
  EXPECT_TRUE(has(page, "width=device-width"));
}

TEST(ReportPage, EscapesWhatFilesSay) {
  const std::string page = report_page(analysis_of(kOne), "1.0");
  EXPECT_TRUE(has(page, "<h1>Is &lt;fast&gt; far &amp; good?</h1>"));
  EXPECT_TRUE(has(page, "it &lt;crashed&gt;"));
  EXPECT_FALSE(has(page, "<crashed>"));
}

TEST(ReportPage, HasTextAsTextAndTheCommandsOfRuns) {
  const std::string page = report_page(analysis_of(kOne), "1.0");
  EXPECT_TRUE(has(page, "class=\"label\">speed=2</text>"));
  EXPECT_TRUE(has(page, "class=\"axis\">way, m</text>"));
  EXPECT_TRUE(has(page, "class=\"axis\">speed, m/s</text>")) << "the curve over the factor";
  EXPECT_TRUE(has(page, ">caught, s (a tick: a run that ended before)</text>"));
  EXPECT_TRUE(has(page, "<pre>rave run room.yaml --set a.speed=2 --seed 2</pre>"));
  EXPECT_TRUE(has(page, "15 of 15 runs, 1 failed"));
  EXPECT_TRUE(has(page, "The experiment file names none."));
  EXPECT_EQ(page, report_page(analysis_of(kOne), "1.0"));
}

TEST(ReportPage, OfTwoFactorsHasAMapOfThem) {
  const std::string two = kOne + ", {name: size, key: b, values: [7, 8]}";
  const std::string page = report_page(analysis_of(two), "1.0");
  EXPECT_TRUE(has(page, "aria-label=\"way over speed and size\""));
  EXPECT_TRUE(has(page, "class=\"best\""));
  EXPECT_FALSE(has(report_page(analysis_of(kOne), "1.0"), "class=\"best\""));
}

TEST(ReportSummary, HasTheTablesOfThePage) {
  const Analysis analysis = analysis_of(kOne);
  const std::string text = report_summary(analysis, 100, false);
  EXPECT_TRUE(text.starts_with("Is <fast> far & good?\nway: 5 with speed=3, the best condition."));
  EXPECT_TRUE(has(text, "1 of 15 runs failed; they count nowhere."));
  const std::string table = condition_table(analysis);
  EXPECT_TRUE(
      table.starts_with("condition,speed,metric,runs,seen,centre,low,high\n1,1,way,5,5,3,"));
  EXPECT_TRUE(has(table, "\n2,2,caught,4,4,3,,\n"));
}

}  // namespace
}  // namespace rave::experiment
