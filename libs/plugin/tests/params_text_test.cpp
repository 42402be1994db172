// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/params_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <sstream>

namespace rave::plugin {
namespace {

constexpr std::array<const char*, 2> kModes{"fast", "slow"};

Driver sample(std::span<const ParamSpec> params) {
  Driver driver;
  driver.info.kind = DriverKind::kVirtualSensor;
  driver.info.name = "laser";
  driver.info.version = "1.2";
  driver.info.summary = "Measures ranges.";
  driver.info.params = params.data();
  driver.info.param_count = params.size();
  driver.file = "/plugins/laser.so";
  return driver;
}

TEST(Describe, IsAPageInColumns) {
  const std::array params{number_param("range_m", "m", 8, 0.1, 30, "Longest range."),
                          bool_param("on", true, "Whether it measures."),
                          choice_param("mode", "slow", kModes, "How it measures."),
                          required(text_param("port", "", "Where it is."))};
  EXPECT_EQ(describe(sample(params)),
            "laser\n"
            "  Measures ranges.\n"
            "\n"
            "  kind     virtual sensor\n"
            "  version  1.2\n"
            "  clock    stepped\n"
            "  file     /plugins/laser.so\n"
            "\n"
            "Parameters\n"
            "  name     type    unit  range        default   meaning\n"
            "  range_m  number  m     0.1 to 30    8         Longest range.\n"
            "  on       bool          true, false  true      Whether it measures.\n"
            "  mode     choice        fast, slow   slow      How it measures.\n"
            "  port     text                       required  Where it is.\n");
  EXPECT_NE(describe(sample({})).find("It has no parameters.\n"), std::string::npos);
}

TEST(Describe, StaysWithinThePageAndLosesNothing) {
  const std::string word(60, 'w');
  std::string doc;
  for (int i = 0; i < 40; ++i) doc += "Sentence" + std::to_string(i) + " ";
  const std::array<const char*, 3> choices{word.c_str(), "one_rather_long_choice", "µm²"};
  const std::array narrow{number_param("a", "m", 1, 0, 2, doc.c_str())};
  const std::array wide{choice_param(word.c_str(), word.c_str(), choices, doc.c_str()),
                        number_param("speed", "µm²/(s·rad·kg·A)", -1e-300, -1e299, 1e299, "x")};
  for (const std::span<const ParamSpec> params :
       {std::span<const ParamSpec>(narrow), std::span<const ParamSpec>(wide)}) {
    Driver driver = sample(params);
    driver.info.summary = doc.c_str();
    const std::string page = describe(driver);
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }),
                100)
          << line;
      EXPECT_FALSE(line.ends_with(' ')) << line;
    }
    for (int i = 0; i < 40; ++i) {
      const std::string part = "Sentence" + std::to_string(i);
      EXPECT_NE(page.find(part, page.find("Parameters")), std::string::npos) << part;
    }
  }
}

TEST(RangeText, KnowsLimitsThatAreNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_EQ(range_text(number_param("a", "", 1, 0, kInfinity, "")), "0 or more");
  EXPECT_EQ(range_text(number_param("a", "", 1, -kMax, 5, "")), "at most 5");
  EXPECT_EQ(range_text(number_param("a", "", 1, -kMax, kMax, "")), "");
  EXPECT_EQ(range_text(integer_param("a", 1, 1, std::numeric_limits<std::int64_t>::max(), "")),
            "1 or more");
  EXPECT_EQ(range_text(text_param("a", "", "")), "");
}

TEST(DefaultText, IsWhatAFileWouldSay) {
  EXPECT_EQ(default_text(bool_param("a", false, "")), "false");
  EXPECT_EQ(default_text(number_param("a", "", 0.1, 0, 1, "")), "0.1");
  EXPECT_EQ(default_text(text_param("a", "", "")), "\"\"");
  EXPECT_EQ(default_text(numbers_param("a", "m", 0, 1, "")), "[]");
  EXPECT_EQ(default_text(required(number_param("a", "", 0.1, 0, 1, ""))), "required");
}

TEST(Describe, SaysOfWhichDeviceItIsAPart) {
  Driver driver = sample({});
  driver.info.device = "rover";
  EXPECT_NE(describe(driver).find("  file     /plugins/laser.so\n  device   part of a `rover`\n\n"),
            std::string::npos)
      << describe(driver);
  EXPECT_NE(markdown(driver).find("Plug-in: `laser.so`. Part of a device `rover`.\n"),
            std::string::npos)
      << markdown(driver);
}

TEST(Describe, ShowsWhatItsCallerKnows) {
  const DriverFact facts[] = {{"gives", "ranges (C++ type float)"}};
  EXPECT_NE(describe(sample({}), facts)
                .find("  clock    stepped\n  gives    ranges (C++ type float)\n  file     "),
            std::string::npos)
      << describe(sample({}), facts);
  EXPECT_NE(markdown(sample({}), facts)
                .find("Clock: stepped. Gives: ranges (C++ type float). Plug-in: `laser.so`."),
            std::string::npos)
      << markdown(sample({}), facts);
}

TEST(Markdown, IsASectionWithoutTheFolder) {
  const std::array params{number_param("range_m", "m", 8, 0.1, 30, "Longest | range."),
                          required(text_param("port", "", "Where it is."))};
  EXPECT_EQ(markdown(sample(params)),
            "### `laser`\n"
            "\n"
            "Measures ranges.\n"
            "\n"
            "Kind: virtual sensor. Version: 1.2. Clock: stepped. Plug-in: `laser.so`.\n"
            "\n"
            "| name | type | unit | range | default | meaning |\n"
            "|---|---|---|---|---|---|\n"
            "| `range_m` | number | m | 0.1 to 30 | `8` | Longest \\| range. |\n"
            "| `port` | text |  |  | required | Where it is. |\n");
}

TEST(Names, AreGivenToAllKindsOfDrivers) {
  for (int i = 0; i <= static_cast<int>(ParamType::kNumbers); ++i) {
    EXPECT_NE(to_string(static_cast<ParamType>(i)), "unknown") << i;
  }
  for (int i = 0; i <= static_cast<int>(DriverKind::kDevice); ++i) {
    EXPECT_NE(rave::to_string(static_cast<DriverKind>(i)), "unknown") << i;
  }
  for (int i = 0; i <= static_cast<int>(DriverClock::kEither); ++i) {
    EXPECT_NE(rave::to_string(static_cast<DriverClock>(i)), "unknown") << i;
  }
  for (int i = 0; i <= static_cast<int>(SampleTiming::kEvents); ++i) {
    EXPECT_NE(rave::to_string(static_cast<SampleTiming>(i)), "unknown") << i;
  }
}

}  // namespace
}  // namespace rave::plugin
