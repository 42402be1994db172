// SPDX-License-Identifier: Apache-2.0
#include "rave/base/table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "rave/base/text_width.hpp"

namespace rave {
namespace {

Table drivers() {
  return {"Drivers",
          {{"name", Align::kLeft, false},
           {"rate", Align::kRight, false},
           {"what it does", Align::kLeft, true}},
          {{"laser", "10", "casts rays"}, {"größe", "2.5"}},
          {}};
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Table, AlignsColumns) {
  EXPECT_EQ(render_table(drivers()),
            "Drivers\n"
            "┌───────┬──────┬──────────────┐\n"
            "│ name  │ rate │ what it does │\n"
            "├───────┼──────┼──────────────┤\n"
            "│ laser │   10 │ casts rays   │\n"
            "│ größe │  2.5 │              │\n"
            "└───────┴──────┴──────────────┘\n");
}

TEST(Table, DrawsRulesBetweenGroups) {
  Table table = drivers();
  table.rules_before = {0, 1};
  const auto lines = split_lines(render_table(table));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[5], "├───────┼──────┼──────────────┤");
}

TEST(Table, WrapsTheColumnThatMay) {
  Table table = drivers();
  table.rows[0][2] = "casts rays through the world and returns ranges";
  const std::string text = render_table(table, {.width = 40, .ansi = false});
  for (const std::string& line : split_lines(text)) EXPECT_LE(columns_of(line), 40U);
  EXPECT_NE(text.find("laser"), std::string::npos);
  EXPECT_NE(text.find("│       │      │"), std::string::npos);
  EXPECT_EQ(text.find("…"), std::string::npos);
}

TEST(Table, NeverWiderThanTheTerminal) {
  Table table = drivers();
  table.rows.push_back({"a_very_long_name_without_blanks", "123456789", "日本語の長い説明文です"});
  for (std::size_t width = 14; width < 80; ++width) {
    const std::string text = render_table(table, {.width = width, .ansi = false});
    const auto lines = split_lines(text);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      EXPECT_LE(columns_of(lines[i]), width);
      EXPECT_EQ(columns_of(lines[i]), columns_of(lines[1]));
    }
  }
}

TEST(Table, LeavesOutColumnsBeforeASentenceGetsTooNarrow) {
  Table table;
  table.columns = {{.heading = "name"},
                   {.heading = "version", .weight = 1},
                   {.heading = "summary", .may_wrap = true},
                   {.heading = "file", .weight = 2}};
  const std::string summary = "Ranges to the nearest bodies along the rays of a scanning laser.";
  table.rows = {{"virtual_laser", "1.0", summary, "virtual_laser.so"}};
  const auto heading_at = [&](std::size_t width) {
    const auto lines = split_lines(render_table(table, {.width = width}));
    for (const std::string& line : lines) EXPECT_LE(columns_of(line), width);
    return lines[1];
  };
  EXPECT_NE(heading_at(100).find("version"), std::string::npos);
  EXPECT_EQ(heading_at(83).find("version"), std::string::npos);
  EXPECT_NE(heading_at(83).find("file"), std::string::npos);
  EXPECT_EQ(heading_at(70).find("file"), std::string::npos);
  EXPECT_NE(heading_at(30).find("summary"), std::string::npos);
}

TEST(Table, EscapeCodesOnlyWhenAsked) {
  EXPECT_EQ(render_table(drivers()).find('\033'), std::string::npos);
  EXPECT_NE(render_table(drivers(), {.width = {}, .ansi = true}).find("\033[1m"),
            std::string::npos);
  Table table = drivers();
  table.rows[0][0] = "a\033[2Jb\n";
  EXPECT_EQ(render_table(table).find('\033'), std::string::npos);
}

TEST(Table, OddTables) {
  EXPECT_EQ(render_table({}), "");
  Table table = drivers();
  table.rows = {{"a", "b", "c", "too many"}};
  EXPECT_EQ(render_table(table).find("too many"), std::string::npos);
}

Table hosts() {
  Table table;
  table.columns = {{.heading = "HOST", .weight = 100},
                   {.heading = "MACHINE", .weight = 40},
                   {.heading = "LOST", .align = Align::kRight, .weight = 65},
                   {.heading = "TRIP", .weight = 30}};
  table.rows = {{"one", "lab-1", {"12", Tone::kCare}}, {"manager", "", "0"}, {"two"}};
  return table;
}

TEST(SpacedTable, HasNoRulesAndNoBlanksAtTheEndsOfLines) {
  EXPECT_EQ(render_table(hosts(), {.look = TableLook::kSpaces}),
            "HOST     MACHINE  LOST\n"
            "one      lab-1      12\n"
            "manager              0\n"
            "two\n");
}

TEST(SpacedTable, LeavesOutTheColumnsOfLeastWeight) {
  const TableOptions narrow{.width = 14, .look = TableLook::kSpaces};
  EXPECT_EQ(render_table(hosts(), narrow), "HOST     LOST\none        12\nmanager     0\ntwo\n");
  const TableOptions tight{.width = 5, .look = TableLook::kSpaces};
  EXPECT_EQ(render_table(hosts(), tight), "HOST\none\nmana…\ntwo\n");
}

TEST(SpacedTable, CountsTheRowsThatHaveNoRoom) {
  const TableOptions low{.width = 40, .look = TableLook::kSpaces, .most_rows = 2};
  EXPECT_EQ(table_lines(hosts(), low).back(), "and 2 more");
  EXPECT_EQ(table_lines(hosts(), low).size(), 3U);
}

TEST(SpacedTable, TonesAreEscapeCodesWhenAsked) {
  const TableOptions colour{.ansi = true, .look = TableLook::kSpaces};
  EXPECT_NE(render_table(hosts(), colour).find("\033[33m12\033[0m"), std::string::npos);
  EXPECT_EQ(render_table(hosts(), {.look = TableLook::kSpaces}).find('\033'), std::string::npos);
}

TEST(SpacedTable, ASentenceStandsBesideItsRowOrBelowIt) {
  Table table;
  table.columns = {{.heading = "name", .widest = 6}, {.heading = "meaning", .below = 12}};
  table.rows = {{"speed", "How fast it goes."}, {"longest one", "x"}};
  EXPECT_EQ(render_table(table, {.width = 24, .look = TableLook::kSpaces, .indent = 2}),
            "  name    meaning\n"
            "  speed   How fast it\n"
            "          goes.\n"
            "  longes  x\n"
            "  t one\n");
  EXPECT_EQ(render_table(table, {.width = 20, .look = TableLook::kSpaces, .indent = 2}),
            "  name\n"
            "      meaning\n"
            "  speed\n"
            "      How fast it\n"
            "      goes.\n"
            "  longes\n"
            "  t one\n"
            "      x\n");
}

TEST(SpacedTable, ColumnsHaveTheirLeastWidth) {
  Table table;
  table.columns = {{.heading = "name", .least = 8}, {.heading = "role"}};
  table.rows = {{"anna", "observer"}};
  EXPECT_EQ(render_table(table, {.look = TableLook::kSpaces}),
            "name      role\nanna      observer\n");
}

TEST(TextWidth, WrapsAtBlanksAndSplitsLongWords) {
  EXPECT_EQ(wrap_to_columns("one two  three", 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap_to_columns("größer", 3), (std::vector<std::string>{"grö", "ßer"}));
  EXPECT_EQ(wrap_to_columns("日本語", 1), (std::vector<std::string>{"日", "本", "語", ""}));
  EXPECT_EQ(wrap_to_columns("", 5), std::vector<std::string>{""});
  EXPECT_EQ(indented("one two", 2, 6), "  one\n  two\n");
}

TEST(TextWidth, CountsTerminalColumns) {
  EXPECT_EQ(columns_of("größe"), 5U);
  EXPECT_EQ(columns_of("日本"), 4U);
  EXPECT_EQ(columns_of("e\u0301"), 1U);
  EXPECT_EQ(clip_to_columns("日本語", 5), "日本…");
  EXPECT_EQ(clip_to_columns("abcdef", 3), "ab…");
  EXPECT_EQ(clip_to_columns("abc", 3), "abc");
}

TEST(TextWidth, KnowsUtf8) {
  EXPECT_TRUE(is_utf8("größe 日本 🤖"));
  for (const std::string_view bad :
       {"\xff", "\xc0\x80", "\xe2\x82", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"}) {
    EXPECT_FALSE(is_utf8(bad));
  }
}

}  // namespace
}  // namespace rave
