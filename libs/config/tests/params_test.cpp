// SPDX-License-Identifier: Apache-2.0
#include "rave/config/params.hpp"

#include <gtest/gtest.h>

#include "rave/config/yaml.hpp"

namespace rave::config {
namespace {

std::vector<FieldSpec> specs() {
  std::vector<FieldSpec> all(7);
  all[0] = {{.doc = "Farthest reading."}, "range_m", ParamType::kDouble};
  all[0].min = 0;
  all[0].exclusive_min = true;
  all[0].unit = "m";
  all[0].default_value = 8.0;
  all[1] = {{.min = 1}, "rays", ParamType::kInt};
  all[1].default_value = std::int64_t{180};
  all[2] = {{}, "noisy", ParamType::kBool};
  all[2].default_value = false;
  all[3] = {{}, "kind", ParamType::kEnum};
  all[3].choices = {"laser", "sonar"};
  all[3].default_value = "laser";
  all[4] = {{.min = 0}, "weights", ParamType::kDoubleList};
  all[4].min_items = 1;
  all[4].default_value = std::vector<double>{1, 2};
  all[5] = {{}, "port", ParamType::kString};
  all[6] = {{}, "label", ParamType::kString};
  all[6].default_value = "";
  return all;
}

RawNode parse(std::string_view text) {
  Diagnostics diagnostics;
  return parse_yaml(text, "r.yaml", diagnostics).value_or(RawNode{});
}

std::string params_error(std::string_view text) {
  const auto values = read_params(parse(text), specs(), "driver `x`");
  return values ? "none" : values.error().text();
}

TEST(Params, GivenValuesAndDefaultsInTheOrderOfTheSpecs) {
  const auto values =
      read_params(parse("port: /dev/ttyS0\nkind: sonar\nrange_m: 3\n"), specs(), "d");
  ASSERT_TRUE(values.has_value()) << values.error().text();
  ASSERT_EQ(values->size(), 7U);
  EXPECT_EQ(values->all()[0].name, "range_m");
  EXPECT_EQ(*values->get<double>("range_m"), 3.0);
  EXPECT_EQ(values->find("range_m")->where.text(), "r.yaml:3:10");
  EXPECT_EQ(*values->get<std::int64_t>("rays"), 180);
  EXPECT_EQ(*values->get<std::string>("kind"), "sonar");
  EXPECT_EQ(*values->get<std::vector<double>>("weights"), (std::vector<double>{1, 2}));
  EXPECT_EQ(values->get<bool>("rays"), nullptr);
  EXPECT_EQ(values->find("nothing"), nullptr);
}

TEST(Params, BadValuesAreNamed) {
  EXPECT_EQ(params_error("port: a\nrange_m: -1\n"),
            "r.yaml:2:10: driver `x`: `range_m`: found the number -1, expected a number (greater "
            "than 0, in metres)");
  EXPECT_EQ(
      params_error("port: a\nrange: 1\n"),
      "r.yaml:2:1: driver `x`: unknown key `range`: unit missing: expected `range_m` (metres)");
  EXPECT_EQ(params_error("port: a\nkinds: sonar\n"),
            "r.yaml:2:1: driver `x`: unknown key `kinds`; did you mean `kind`?");
  EXPECT_EQ(params_error("port: a\nkind: sonr\n"),
            "r.yaml:2:7: driver `x`: `kind`: found the text \"sonr\", expected one of laser and "
            "sonar; did you mean `sonar`?");
  EXPECT_EQ(params_error("port: a\nrays: 2.5\n"),
            "r.yaml:2:7: driver `x`: `rays`: found the number 2.5, expected a whole number (at "
            "least 1)");
  EXPECT_EQ(params_error("port: a\nweights: [1, -1]\n"),
            "r.yaml:2:14: driver `x`: item 2 of `weights`: found the number -1, expected a number "
            "(at least 0)");
  EXPECT_EQ(params_error("rays: 3\n"), "r.yaml:1:1: driver `x`: missing key `port`: expected text");
  EXPECT_EQ(params_error("[1]"), "r.yaml:1:1: driver `x`: found a list, expected a mapping");
}

TEST(Params, NothingGivenIsTheDefaults) {
  auto all = specs();
  all.erase(all.begin() + 5);
  const auto values = read_params(RawNode{}, all, "d");
  ASSERT_TRUE(values.has_value());
  EXPECT_EQ(values->size(), 6U);
}

}  // namespace
}  // namespace rave::config
