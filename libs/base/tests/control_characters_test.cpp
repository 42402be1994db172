// SPDX-License-Identifier: Apache-2.0
#include "rave/base/control_characters.hpp"

#include <gtest/gtest.h>

namespace rave {
namespace {

TEST(ControlCharacters, AreFoundHoweverTheyAreWritten) {
  EXPECT_TRUE(has_control_characters("a\x1b[2J"));
  EXPECT_TRUE(has_control_characters("a\x7f"));
  EXPECT_TRUE(has_control_characters(std::string_view("a\0b", 3)));
  // U+009B begins what ESC [ begins.
  EXPECT_TRUE(
      has_control_characters("a\xc2\x9b"
                             "2J"));
  EXPECT_TRUE(has_control_characters("\xc2\x80"));
  EXPECT_TRUE(has_control_characters("\xc2\x9f"));
  EXPECT_TRUE(
      has_control_characters("a\x9b"
                             "2J"))
      << "as a byte";
  EXPECT_TRUE(has_control_characters("\xc0\x9b")) << "ESC in two bytes";
  EXPECT_TRUE(has_control_characters("\xe0\x82\x9b")) << "U+009B in three";
  EXPECT_TRUE(has_control_characters("\xf0\x80\x82\x9b")) << "and in four";
  EXPECT_TRUE(has_control_characters("\xe4\x9b")) << "a character that is cut off";
}

TEST(ControlCharacters, NamesOfAllLanguagesHaveNone) {
  EXPECT_FALSE(has_control_characters(""));
  EXPECT_FALSE(has_control_characters("Größe\xc2\xa0m"));
  // Bytes from 80 to 9f are a part of other characters.
  EXPECT_FALSE(has_control_characters("ロボット Робот \xf0\x9f\xa4\x96 ěśē"));
  EXPECT_FALSE(has_control_characters("\xe9t\xe9")) << "Latin 1";
}

TEST(ControlCharacters, AreReplacedAndNothingElse) {
  EXPECT_EQ(without_control_characters("a\x1b[2Jb\n", ""), "a[2Jb");
  EXPECT_EQ(without_control_characters("a\xc2\x9b"
                                       "2Jロ\x85",
                                       "?"),
            "a?2Jロ?");
  EXPECT_EQ(without_control_characters("\xff\xe9", "?"), "\xff\xe9");
}

}  // namespace
}  // namespace rave
