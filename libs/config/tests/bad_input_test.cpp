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

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsRefusedWithItsPlaceAndWhatWasExpected) {
  const auto value = read_text<sample::Laser>(GetParam().text, "a.yaml");
  ASSERT_FALSE(value.has_value());
  EXPECT_EQ(value.error().text(), GetParam().error);
}

const Case kCases[] = {
    {"Empty", "", "?"},
    {"OnlyAComment", "# nothing\n", "?"},
    {"OnlyNull", "~\n", "?"},
    {"AList", "- 1\n", "?"},
    {"AWord", "hello\n", "?"},
    {"UnknownKey", "frame: base\nrnage_m: 3\n", "?"},
    {"UnknownKeyFarFromAll", "frame: base\nxyzzyplugh: 3\n", "?"},
    {"UnitMissing", "frame: base\nrange: 3\n", "?"},
    {"UnitMissingDegrees", "frame: base\nfov: 3\n", "?"},
    {"OtherUnit", "frame: base\nrange_cm: 3\n", "?"},
    {"UnitMissingNested", "frame: base\nmounts:\n  - at_m: [1, 2]\n    heading: 3\n", "?"},
    {"DuplicateKey", "frame: base\nrays: 3\nrays: 4\n", "?"},
    {"DuplicateKeyInOpaquePart", "frame: base\nparams: {a: 1, b: 2, a: 3}\n", "?"},
    {"MissingRequired", "rays: 4\n", "?"},
    {"MissingRequiredNested", "frame: base\nmounts:\n  - heading_deg: 3\n", "?"},
    {"TextForNumber", "frame: base\nrange_m: far\n", "?"},
    {"NumberWithUnit", "frame: base\nrange_m: 3 m\n", "?"},
    {"QuotedNumber", "frame: base\nrange_m: \"3\"\n", "?"},
    {"NothingForNumber", "frame: base\nrange_m:\nrays: 4\n", "?"},
    {"ListForNumber", "frame: base\nrange_m: [1]\n", "?"},
    {"MappingForNumber", "frame: base\nrange_m: {a: 1}\n", "?"},
    {"BoolForNumber", "frame: base\nrange_m: true\n", "?"},
    {"NegativeRange", "frame: base\nrange_m: -1\n", "?"},
    {"ZeroRange", "frame: base\nrange_m: 0\n", "?"},
    {"NotANumber", "frame: base\nrange_m: .nan\n", "?"},
    {"NanAsAWord", "frame: base\nrange_m: nan\n", "?"},
    {"InfiniteRange", "frame: base\nrange_m: .inf\n", "?"},
    {"InfiniteOutOfRange", "frame: base\nhorizon_s: -.inf\n", "?"},
    {"NumberTooLarge", "frame: base\nrange_m: 1e999\n", "?"},
    {"HexNumber", "frame: base\nrange_m: 0x10\n", "?"},
    {"OctalNumber", "frame: base\nrays: 010\n", "?"},
    {"FractionForInt", "frame: base\nrays: 3.5\n", "?"},
    {"RoundFractionForInt", "frame: base\nrays: 4.0\n", "?"},
    {"ExponentForInt", "frame: base\nrays: 1e3\n", "?"},
    {"UnderscoreInInt", "frame: base\nrays: 1_000\n", "?"},
    {"IntTooLargeForItsType", "frame: base\nrays: 99999999999\n", "?"},
    {"IntTooLargeForAny", "frame: base\noffset: 99999999999999999999\n", "?"},
    {"NegativeSeed", "frame: base\nseed: -1\n", "?"},
    {"SeedTooLarge", "frame: base\nseed: 18446744073709551616\n", "?"},
    {"YesForTrue", "frame: base\nenabled: yes\n", "?"},
    {"CapitalTrue", "frame: base\nenabled: True\n", "?"},
    {"OneForTrue", "frame: base\nenabled: 1\n", "?"},
    {"QuotedTrue", "frame: base\nenabled: \"true\"\n", "?"},
    {"NumberForText", "frame: 3\n", "?"},
    {"BoolForText", "frame: true\n", "?"},
    {"EmptyText", "frame: \"\"\n", "?"},
    {"NothingForText", "frame:\n", "?"},
    {"UnknownChoice", "frame: base\nrole: obsrver\n", "?"},
    {"UnknownChoiceFarFromAll", "frame: base\nrole: king\n", "?"},
    {"NumberForChoice", "frame: base\nrole: 3\n", "?"},
    {"ArrayTooShort", "frame: base\nmounts:\n  - at_m: [1]\n", "?"},
    {"ArrayTooLong", "frame: base\nmounts:\n  - at_m: [1, 2, 3]\n", "?"},
    {"BadItemOfArray", "frame: base\nmounts:\n  - at_m: [1, x]\n", "?"},
    {"ListTooLong", "frame: base\nmounts: [[1, 2], [1, 2], [1, 2], [1, 2], [1, 2]]\n", "?"},
    {"MappingForList", "frame: base\nmounts: {at_m: [1, 2]}\n", "?"},
    {"BadShorthand", "frame: base\nmounts: [[1, 2], [1, b]]\n", "?"},
    {"ScalarForShorthand", "frame: base\nspare: 7\n", "?"},
    {"BadItemOfNestedList", "frame: base\nrows: [[1, 2], [3, four]]\n", "?"},
    {"ListForMap", "frame: base\nnamed: [1]\n", "?"},
    {"BadValueOfMap", "frame: base\nnamed:\n  left: {at_m: [1, 2], heading_deg: 270}\n", "?"},
    {"CrossFieldAtItsKey", "frame: base\nrange_m: 2\nmin_range_m: 3\n", "?"},
    {"CrossFieldAtTheMapping", "fov_deg: 360\nrays: 3\nframe: base\n", "?"},
    {"SyntaxUnclosedList", "frame: base\nrows: [1, 2\n", "?"},
    {"SyntaxTab", "frame: base\nnamed:\n\tleft: 3\n", "?"},
    {"SyntaxUnclosedQuote", "frame: \"base\n", "?"},
    {"SyntaxBadIndent", "frame: base\n  rays: 3\n", "?"},
    {"UnknownAlias", "frame: base\nparams: *nobody\n", "?"},
    {"AliasInsideItself", "frame: base\nparams: &a [*a]\n", "?"},
    {"Tag", "frame: base\nrays: !!int 3\n", "?"},
    {"OwnTag", "frame: base\nparams: !thing {a: 1}\n", "?"},
    {"MergeKey", "frame: base\nparams: {<<: {a: 1}}\n", "?"},
    {"ListAsKey", "frame: base\nparams: {[1]: 2}\n", "?"},
    {"EmptyKey", "frame: base\nparams: {: 2}\n", "?"},
    {"TwoDocuments", "frame: base\n---\nrays: 3\n", "?"},
    {"NotUtf8", "frame: base\nrole: \xff\n", "?"},
    {"ControlCharacter", "frame: base\nrole: a\x01\n", "?"},
};

INSTANTIATE_TEST_SUITE_P(Config, BadInput, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadInputTogether, AllErrorsAreReportedInTheOrderOfTheFile) {
  Diagnostics diagnostics;
  const auto value = read_text<sample::Laser>(
      "frame: base\nrays: 0\nrnage_m: 3\nrays: 4\nenabled: no\n", "a.yaml", diagnostics);
  ASSERT_FALSE(value.has_value());
  EXPECT_EQ(diagnostics.size(), 4U);
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
            "a.yaml: the file is larger than 16777216 bytes");
  EXPECT_EQ(error_of("params: " + std::string(100, '[') + std::string(100, ']')),
            "a.yaml:1:72: lists and mappings are nested deeper than 64");
  EXPECT_EQ(error_of(std::string(20000, '[')),
            "a.yaml:1:65: lists and mappings are nested deeper than 64");
  std::string bomb = "params:\n  a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    bomb += fmt::format("  a{}: &a{} [", i, i);
    for (int k = 0; k < 10; ++k) bomb += fmt::format("{}*a{}", k == 0 ? "" : ", ", i - 1);
    bomb += "]\n";
  }
  EXPECT_EQ(error_of(bomb),
            "a.yaml:7:28: more than 1000000 values, counting what aliases stand for");
}

}  // namespace
}  // namespace rave::config
