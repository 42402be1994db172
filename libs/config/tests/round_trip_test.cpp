// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>

#include "rave/base/random.hpp"
#include "sample_config.hpp"

namespace rave::config {
namespace {

using sample::Laser;
using sample::Mount;

TEST(Read, AllTypes) {
  const auto laser = read_text<Laser>(
      "frame: base\ndriver: sick\nrange_m: 3\nseed: 18446744073709551615\n"
      "offset: -9223372036854775808\nfov_deg: 90\nhorizon_s: 5\n"
      "mounts: [{at_m: [1, 2]}, {at_m: [3, 4], heading_deg: -90}]\nrows: [[1], [], [2, 3]]\n"
      "named: {b: {at_m: [1, 1]}, a: {at_m: [2, 2]}}\nrole: super_user\nspare: null\nparams: "
      "{gain: 2}\n",
      "a.yaml");
  ASSERT_TRUE(laser.has_value()) << laser.error().text();
  EXPECT_EQ(laser->range_m, 3.0);
  EXPECT_EQ(laser->seed, 18446744073709551615U);
  EXPECT_EQ(laser->offset, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(laser->fov_deg, 90.0);
  EXPECT_EQ(laser->mounts.at(1), (Mount{{3, 4}, -90}));
  EXPECT_EQ(laser->rows, (std::vector<std::vector<double>>{{1}, {}, {2, 3}}));
  EXPECT_EQ(laser->named.begin()->first, "a");
  EXPECT_EQ(laser->role, sample::Role::kSuperUser);
  EXPECT_FALSE(laser->spare.has_value());
  EXPECT_EQ(laser->driver.value, "sick");
  EXPECT_EQ(laser->driver.where.text(), "a.yaml:2:9");
  EXPECT_EQ(laser->params.find("gain")->where().text(), "a.yaml:13:16");
  EXPECT_EQ(laser->rays, 180);
}

TEST(Write, EveryFieldWithItsUnitAndSentence) {
  Laser laser;
  laser.frame = "base";
  laser.mounts.push_back({{1, 2.5}, 0});
  EXPECT_EQ(write_text(laser),
            "range_m: 8  # [m] Farthest reading.\n"
            "min_range_m: 0  # [m] Nearest reading.\n"
            "rays: 180  # Beams in one sweep.\n"
            "seed: 7\n"
            "offset: 0\n"
            "enabled: true\n"
            "frame: base  # The frame that it is mounted in.\n"
            "driver: \"\"  # The driver's name.\n"
            "fov_deg: null  # [deg] Opening angle.\n"
            "horizon_s: 0  # [s]\n"
            "mounts:  # Where copies of it sit.\n"
            "  - at_m: [1, 2.5]  # [m] Place on the body.\n"
            "    heading_deg: 0  # [deg]\n"
            "rows: []\n"
            "named: {}\n"
            "role: observer  # Who may see it.\n"
            "spare: null\n"
            "params: null  # What the driver takes.\n");
}

/// Random values that fulfil the limits of the description.
class Generator {
 public:
  explicit Generator(std::uint32_t sample) : random_(5, 0, 0, sample) {}

  Laser laser() {
    Laser c;
    c.range_m = 1e-3 + random_.uniform(0, 1e6);
    c.min_range_m = c.range_m * random_.uniform(0, 0.9);
    c.rays = 2 * static_cast<int>(below(50000)) + 2;
    c.seed = (std::uint64_t{random_.bits()} << 32) | random_.bits();
    c.offset = std::bit_cast<std::int64_t>((std::uint64_t{random_.bits()} << 32) | random_.bits());
    c.enabled = below(2) == 1;
    c.frame = "f" + word();
    c.driver = word();
    if (below(2) == 1) c.fov_deg = random_.uniform(0, 360);
    c.horizon_s = random_.uniform();
    for (auto n = below(5); n > 0; --n) c.mounts.push_back(mount());
    for (auto n = below(4); n > 0; --n) c.rows.emplace_back(below(30), any_double());
    for (auto n = below(4); n > 0; --n) c.named[word()] = mount();
    c.role = static_cast<sample::Role>(below(3));
    if (below(2) == 1) c.spare = mount();
    c.params = tree(3);
    return c;
  }

 private:
  std::uint32_t below(std::uint32_t limit) { return random_.bits() % limit; }
  Mount mount() { return {{any_double(), any_double()}, random_.uniform(-180, 180)}; }
  double any_double() {
    const auto value =
        std::bit_cast<double>((std::uint64_t{random_.bits()} << 32) | random_.bits());
    return std::isfinite(value) ? value : 1.0;
  }
  std::string word() {
    static constexpr std::array<std::string_view, 24> kPieces = {
        "a", "no", "true", "~",  ":", " ", "#", "-", "\n", "\t",   "\"",       "\\",
        "'", "ü",  "3",    ".5", "{", "]", "&", "*", "!",  "\x01", "\xC2\x85", "\xF0\x9F\xA4\x96"};
    std::string text;
    for (auto n = below(5); n > 0; --n) text += kPieces[below(24)];
    return text;
  }
  RawNode tree(int depth) {
    switch (below(depth > 0 ? 7 : 5)) {
      case 0:
        return {};
      case 1:
        return RawNode::number(any_double());
      case 2:
        return RawNode::boolean(below(2) == 1);
      case 3:
      case 4:
        return RawNode::text(word());
      case 5: {
        RawNode node = RawNode::sequence();
        for (auto n = below(4); n > 0; --n) node.push_back(tree(depth - 1));
        return node;
      }
      default: {
        RawNode node = RawNode::mapping();
        for (auto n = below(4); n > 0; --n) {
          std::string key = word();
          key += "k";
          node.set(key, tree(depth - 1));
        }
        return node;
      }
    }
  }

  RandomStream random_;
};

TEST(RoundTrip, WhatIsWrittenReadsBackEqual) {
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Laser laser = Generator(i).laser();
    const std::string text = write_text(laser);
    const auto again = read_text<Laser>(text, "again.yaml");
    ASSERT_TRUE(again.has_value()) << i << "\n" << text << "\n" << again.error().text();
    ASSERT_TRUE(*again == laser) << i << "\n" << text << "\n" << write_text(*again);
    ASSERT_EQ(write_text(*again), text);
  }
}

}  // namespace
}  // namespace rave::config
