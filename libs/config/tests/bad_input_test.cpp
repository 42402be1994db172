// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sample_config.hpp"

namespace rave::config {
namespace {

struct Case {
  const char* name;
  const char* text;
  const char* error;
};

// The name that GoogleTest looks for. NOLINTNEXTLINE(readability-identifier-naming)
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsRefusedWithItsPlaceAndWhatWasExpected) {
  const auto value = read_text<sample::Laser>(GetParam().text, "a.yaml");
  ASSERT_FALSE(value.has_value());
  EXPECT_EQ(value.error().text(), GetParam().error);
}

const Case kCases[] = {
    {"Empty", "", "a.yaml:1:1: the file is empty"},
    {"OnlyAComment", "# nothing\n", "a.yaml:1:1: the file is empty"},
    {"OnlyNull", "~\n", "a.yaml:1:1: the file is empty"},
    {"AList", "- 1\n", "a.yaml:1:1: found a list, expected a mapping"},
    {"AWord", "hello\n", "a.yaml:1:1: found the text \"hello\", expected a mapping"},
    {"UnknownKey", "frame: base\nrnage_m: 3\n",
     "a.yaml:2:1: unknown key `rnage_m`; did you mean `range_m`?"},
    {"UnknownKeyFarFromAll", "frame: base\nxyzzyplugh: 3\n",
     "a.yaml:2:1: unknown key `xyzzyplugh`; there are range_m, min_range_m, rays, seed, offset, "
     "enabled, frame, driver, fov_deg, horizon_s, mounts, rows, named, role, spare and params"},
    {"UnitMissing", "frame: base\nrange: 3\n",
     "a.yaml:2:1: unknown key `range`: unit missing: expected `range_m` (metres)"},
    {"UnitMissingDegrees", "frame: base\nfov: 3\n",
     "a.yaml:2:1: unknown key `fov`: unit missing: expected `fov_deg` (degrees)"},
    {"OtherUnit", "frame: base\nrange_cm: 3\n",
     "a.yaml:2:1: unknown key `range_cm`; did you mean `range_m`?"},
    {"UnitMissingNested", "frame: base\nmounts:\n  - at_m: [1, 2]\n    heading: 3\n",
     "a.yaml:4:5: unknown key `heading`: unit missing: expected `heading_deg` (degrees)"},
    {"DuplicateKey", "frame: base\nrays: 3\nrays: 4\n",
     "a.yaml:3:1: the key `rays` is given twice"},
    {"DuplicateKeyInOpaquePart", "frame: base\nparams: {a: 1, b: 2, a: 3}\n",
     "a.yaml:2:22: the key `a` is given twice"},
    {"MissingRequired", "rays: 4\n",
     "a.yaml:1:1: missing key `frame`: expected text that is not empty"},
    {"MissingRequiredNested", "frame: base\nmounts:\n  - heading_deg: 3\n",
     "a.yaml:3:5: missing key `at_m`: expected a list of 2 items, each a number (in metres)"},
    {"TextForNumber", "frame: base\nrange_m: far\n",
     "a.yaml:2:10: `range_m`: found the text \"far\", expected a number (greater than 0, in "
     "metres)"},
    {"NumberWithUnit", "frame: base\nrange_m: 3 m\n",
     "a.yaml:2:10: `range_m`: found the text \"3 m\", expected a number (greater than 0, in "
     "metres)"},
    {"QuotedNumber", "frame: base\nrange_m: \"3\"\n",
     "a.yaml:2:10: `range_m`: found the text \"3\", expected a number (greater than 0, in metres)"},
    {"NothingForNumber", "frame: base\nrange_m:\nrays: 4\n",
     "a.yaml:2:1: `range_m`: found nothing, expected a number (greater than 0, in metres)"},
    {"ListForNumber", "frame: base\nrange_m: [1]\n",
     "a.yaml:2:10: `range_m`: found a list, expected a number (greater than 0, in metres)"},
    {"MappingForNumber", "frame: base\nrange_m: {a: 1}\n",
     "a.yaml:2:10: `range_m`: found a mapping, expected a number (greater than 0, in metres)"},
    {"BoolForNumber", "frame: base\nrange_m: true\n",
     "a.yaml:2:10: `range_m`: found true, expected a number (greater than 0, in metres)"},
    {"NegativeRange", "frame: base\nrange_m: -1\n",
     "a.yaml:2:10: `range_m`: found the number -1, expected a number (greater than 0, in metres)"},
    {"ZeroRange", "frame: base\nrange_m: 0\n",
     "a.yaml:2:10: `range_m`: found the number 0, expected a number (greater than 0, in metres)"},
    {"NotANumber", "frame: base\nrange_m: .nan\n",
     "a.yaml:2:10: `range_m`: found the number .nan, expected a finite number (greater than 0, in "
     "metres)"},
    {"NanAsAWord", "frame: base\nrange_m: nan\n",
     "a.yaml:2:10: `range_m`: found the text \"nan\", expected a number (greater than 0, in "
     "metres)"},
    {"InfiniteRange", "frame: base\nrange_m: .inf\n",
     "a.yaml:2:10: `range_m`: found the number .inf, expected a finite number (greater than 0, in "
     "metres)"},
    {"NumberTooLarge", "frame: base\nrange_m: 1e999\n",
     "a.yaml:2:10: `range_m`: found the number 1e999, expected a number within the range of a "
     "double (greater than 0, in metres)"},
    {"HexNumber", "frame: base\nrange_m: 0x10\n",
     "a.yaml:2:10: `range_m`: found the text \"0x10\", expected a number (greater than 0, in "
     "metres)"},
    {"OctalNumber", "frame: base\nrays: 010\n",
     "a.yaml:2:7: `rays`: found the text \"010\", expected a whole number (from 1 to 100000)"},
    {"FractionForInt", "frame: base\nrays: 3.5\n",
     "a.yaml:2:7: `rays`: found the number 3.5, expected a whole number (from 1 to 100000)"},
    {"RoundFractionForInt", "frame: base\nrays: 4.0\n",
     "a.yaml:2:7: `rays`: found the number 4.0, expected a whole number (from 1 to 100000)"},
    {"ExponentForInt", "frame: base\nrays: 1e3\n",
     "a.yaml:2:7: `rays`: found the number 1e3, expected a whole number (from 1 to 100000)"},
    {"UnderscoreInInt", "frame: base\nrays: 1_000\n",
     "a.yaml:2:7: `rays`: found the text \"1_000\", expected a whole number (from 1 to 100000)"},
    {"IntTooLargeForItsType", "frame: base\nrays: 99999999999\n",
     "a.yaml:2:7: `rays`: found the number 99999999999, expected a whole number (from 1 to "
     "100000)"},
    {"IntTooLargeForAny", "frame: base\noffset: 99999999999999999999\n",
     "a.yaml:2:9: `offset`: found the number 99999999999999999999, expected a whole number (from "
     "-9223372036854775808 to 9223372036854775807)"},
    {"NegativeSeed", "frame: base\nseed: -1\n",
     "a.yaml:2:7: `seed`: found the number -1, expected a whole number (at least 0)"},
    {"SeedTooLarge", "frame: base\nseed: 18446744073709551616\n",
     "a.yaml:2:7: `seed`: found the number 18446744073709551616, expected a whole number (from 0 "
     "to 18446744073709551615)"},
    {"YesForTrue", "frame: base\nenabled: yes\n",
     "a.yaml:2:10: `enabled`: found the text \"yes\", expected true or false"},
    {"OddTrue", "frame: base\nenabled: TrUe\n",
     "a.yaml:2:10: `enabled`: found the text \"TrUe\", expected true or false"},
    {"OneForTrue", "frame: base\nenabled: 1\n",
     "a.yaml:2:10: `enabled`: found the number 1, expected true or false"},
    {"QuotedTrue", "frame: base\nenabled: \"true\"\n",
     "a.yaml:2:10: `enabled`: found the text \"true\", expected true or false"},
    {"NumberForText", "frame: 3\n",
     "a.yaml:1:8: `frame`: found the number 3, expected text that is not empty (put it in quotes)"},
    {"BoolForText", "frame: true\n",
     "a.yaml:1:8: `frame`: found true, expected text that is not empty (put it in quotes)"},
    {"EmptyText", "frame: \"\"\n",
     "a.yaml:1:8: `frame`: found the text \"\", expected text that is not empty"},
    {"NothingForText", "frame:\n",
     "a.yaml:1:1: `frame`: found nothing, expected text that is not empty"},
    {"UnknownChoice", "frame: base\nrole: obsrver\n",
     "a.yaml:2:7: `role`: found the text \"obsrver\", expected one of observer, commander and "
     "super_user; did you mean `observer`?"},
    {"UnknownChoiceFarFromAll", "frame: base\nrole: king\n",
     "a.yaml:2:7: `role`: found the text \"king\", expected one of observer, commander and "
     "super_user"},
    {"NumberForChoice", "frame: base\nrole: 3\n",
     "a.yaml:2:7: `role`: found the number 3, expected one of observer, commander and super_user"},
    {"ArrayTooShort", "frame: base\nmounts:\n  - at_m: [1]\n",
     "a.yaml:3:11: `at_m`: found a list of 1 item, expected a list of 2 items, each a number (in "
     "metres)"},
    {"ArrayTooLong", "frame: base\nmounts:\n  - at_m: [1, 2, 3]\n",
     "a.yaml:3:11: `at_m`: found a list of 3 items, expected a list of 2 items, each a number (in "
     "metres)"},
    {"BadItemOfArray", "frame: base\nmounts:\n  - at_m: [1, x]\n",
     "a.yaml:3:15: item 2 of `at_m`: found the text \"x\", expected a number (in metres)"},
    {"ListTooLong", "frame: base\nmounts: [{}, {}, {}, {}, {}]\n",
     "a.yaml:2:9: `mounts`: found a list of 5 items, expected a list of at most 4 items, each a "
     "mapping"},
    {"MappingForList", "frame: base\nmounts: {at_m: [1, 2]}\n",
     "a.yaml:2:9: `mounts`: found a mapping, expected a list of at most 4 items, each a mapping"},
    {"BadItemOfNestedList", "frame: base\nrows: [[1, 2], [3, four]]\n",
     "a.yaml:2:20: item 2 of item 2 of `rows`: found the text \"four\", expected a number"},
    {"ListForMap", "frame: base\nnamed: [1]\n",
     "a.yaml:2:8: `named`: found a list, expected a mapping, each value a mapping"},
    {"BadValueOfMap", "frame: base\nnamed:\n  left: {at_m: [1, 2], heading_deg: 270}\n",
     "a.yaml:3:37: `heading_deg`: found the number 270, expected a number (from -180 to 180, in "
     "degrees)"},
    {"CrossFieldAtItsKey", "frame: base\nrange_m: 2\nmin_range_m: 3\n",
     "a.yaml:3:14: `min_range_m`: found 3, expected less than `range_m` (2)"},
    {"CrossFieldAtTheMapping", "fov_deg: 360\nrays: 3\nframe: base\n",
     "a.yaml:1:1: a full circle needs an even number of rays, found 3"},
    {"SyntaxUnclosedList", "frame: base\nrows: [1, 2\n",
     "a.yaml:3:1: YAML syntax: end of sequence flow not found; see also the line before: a colon, "
     "a bracket or the indent"},
    {"SyntaxTab", "frame: base\nnamed:\n\tleft: 3\n",
     "a.yaml:3:1: YAML syntax: found a tab in the indent, expected spaces"},
    {"SyntaxTabAfterSpaces", "frame: base\nmount:\n  \tx_m: 1\n",
     "a.yaml:3:3: YAML syntax: found a tab in the indent, expected spaces"},
    {"SyntaxTabOfAList", "frame: base\nmounts:\n\t- x_m: 1\n",
     "a.yaml:3:1: YAML syntax: found a tab in the indent, expected spaces"},
    {"SyntaxTabAfterALine", "frame: base\n\trays: 3\n",
     "a.yaml:2:1: YAML syntax: found a tab in the indent, expected spaces"},
    {"SyntaxUnclosedQuote", "frame: \"base\n", "a.yaml:1:8: YAML syntax: a quote is not closed"},
    {"SyntaxUnclosedQuoteWithTheMark", "frame: \"#end-of-file-2f6c1d\n",
     "a.yaml:1:8: YAML syntax: a quote is not closed"},
    {"SyntaxUnclosedSingleQuote", "frame: base\nparams:\n  a: 'b\n\n\n",
     "a.yaml:3:6: YAML syntax: a quote is not closed"},
    {"SyntaxUnclosedQuoteWithoutLineBreak", "frame: \"base",
     "a.yaml:1:13: YAML syntax: illegal EOF in scalar"},
    {"SyntaxBadIndent", "frame: base\n  rays: 3\n",
     "a.yaml:2:7: YAML syntax: illegal map value; see also the line before: a colon, a bracket or "
     "the indent"},
    {"UnknownAlias", "frame: base\nparams: *nobody\n",
     "a.yaml:2:9: YAML syntax: the referenced anchor is not defined"},
    {"AliasInsideItself", "frame: base\nparams: &a [*a]\n",
     "a.yaml:2:13: an alias refers to a value that contains it"},
    {"Tag", "frame: base\nrays: !!int 3\n",
     "a.yaml:2:7: tags are not allowed, found `tag:yaml.org,2002:int`"},
    {"OwnTag", "frame: base\nparams: !thing {a: 1}\n",
     "a.yaml:2:9: tags are not allowed, found `!thing`"},
    {"MergeKey", "frame: base\nparams: {<<: {a: 1}}\n",
     "a.yaml:2:10: merge keys (`<<`) are not allowed: write the entries out"},
    {"ListAsKey", "frame: base\nparams: {[1]: 2}\n",
     "a.yaml:2:10: a key must be a word, found a list"},
    {"EmptyKey", "frame: base\nparams: {: 2}\n",
     "a.yaml:2:10: a key must be a word, found nothing"},
    {"TwoDocuments", "frame: base\n---\nrays: 3\n",
     "a.yaml:2:1: expected one document, found a second one"},
    {"NotUtf8", "frame: base\nrole: \xff\n", "a.yaml:2:7: the file is not UTF-8 text"},
    {"ControlCharacter", "frame: base\nrole: a\x01\n",
     "a.yaml:2:8: found a control character (code 1)"},
    {"ControlCharacterOfTwoBytes", "frame: base\nrole: a\xc2\x9b\n",
     "a.yaml:2:8: found a control character (code 155)"},
};

INSTANTIATE_TEST_SUITE_P(Config, BadInput, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadInputTogether, AllErrorsAreReportedInTheOrderOfTheFile) {
  const auto value = read_text<sample::Laser>(
      "frame: base\nrays: 0\nrnage_m: 3\nrays: 4\nenabled: no\n", "a.yaml");
  ASSERT_FALSE(value.has_value());
  EXPECT_EQ(value.error().text(),
            "a.yaml:2:7: `rays`: found the number 0, expected a whole number (from 1 to 100000)\n"
            "a.yaml:3:1: unknown key `rnage_m`; did you mean `range_m`?\n"
            "a.yaml:4:1: the key `rays` is given twice\n"
            "a.yaml:5:10: `enabled`: found the text \"no\", expected true or false");
}

TEST(BadInputTogether, AtMostTwentyAreShown) {
  std::string text = "frame: base\n";
  for (int i = 0; i < 30; ++i) text += fmt::format("xyzzy{}: 1\n", i);
  const auto value = read_text<sample::Laser>(text, "a.yaml");
  ASSERT_FALSE(value.has_value());
  const std::string all = value.error().text();
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 20);
  EXPECT_TRUE(all.ends_with("\nand 10 more")) << all;
}

TEST(BadInputFile, MissingAndFolder) {
  EXPECT_EQ(read_file<sample::Laser>("no/such.yaml").error().text(),
            "cannot open `no/such.yaml`: No such file or directory");
  EXPECT_EQ(read_file<sample::Laser>("/").error().text(), "cannot read `/`: it is a folder");
}

TEST(BadInputLimits, TooLargeTooDeepTooManyValues) {
  const auto error_of = [](const std::string& text) {
    const auto value = read_text<sample::Laser>(text, "a.yaml");
    return value ? std::string("none") : value.error().text();
  };
  EXPECT_EQ(error_of(std::string(kMaxFileBytes + 1, ' ')),
            "a.yaml: the file is larger than 67108864 bytes");
  EXPECT_EQ(error_of("params: " + std::string(100, '[') + std::string(100, ']')),
            "a.yaml:1:72: lists and mappings are nested deeper than 64");
  EXPECT_TRUE(error_of(std::string(20000, '['))
                  .ends_with(": lists and mappings are nested deeper than 64"));
  std::string bomb = "params:\n  a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    bomb += fmt::format("  a{}: &a{} [", i, i);
    for (int k = 0; k < 10; ++k) bomb += fmt::format("{}*a{}", k == 0 ? "" : ", ", i - 1);
    bomb += "]\n";
  }
  EXPECT_EQ(error_of(bomb), "a.yaml:7:42: aliases stand for more than 1000000 values");
}

}  // namespace
}  // namespace rave::config
