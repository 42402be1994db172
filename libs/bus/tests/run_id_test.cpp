// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/run_id.hpp"

#include <gtest/gtest.h>

namespace rave::bus {
namespace {

TEST(RunId, GoesThroughItsText) {
  const RunId id = RunId::random();
  EXPECT_FALSE(id.none());
  EXPECT_EQ(id.text().size(), 32U);
  const auto again = RunId::parse(id.text());
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, id);
  EXPECT_EQ(RunId::parse("000102030405060708090a0b0c0d0eff")->bytes[15], 0xff);
}

TEST(RunId, IsAnotherEachTime) {
  EXPECT_NE(RunId::random(), RunId::random());
  EXPECT_NE(random_writer_id(), random_writer_id());
}

TEST(RunId, RefusesOtherText) {
  EXPECT_EQ(RunId::parse("12").error().message,
            "a run id has 32 hexadecimal digits, not 2 characters");
  EXPECT_EQ(RunId::parse("0001020304050607-8090a0b0c0d0e0f").error().message,
            "a run id has hexadecimal digits only, not `-8`");
}

TEST(RunId, OfANameIsTheSameForAll) {
  EXPECT_EQ(run_of_name("morning"), run_of_name("morning"));
  EXPECT_NE(run_of_name("morning"), run_of_name("evening"));
  EXPECT_NE(run_of_number(1), run_of_number(2));
  EXPECT_FALSE(run_of_name("").none());
}

TEST(RunId, ComparesWithWhatIsOnTheWire) {
  RunId id;
  id.bytes[3] = 7;
  std::uint8_t wire[16] = {0, 0, 0, 7};
  EXPECT_TRUE(id.equals(wire));
  wire[15] = 1;
  EXPECT_FALSE(id.equals(wire));
}

}  // namespace
}  // namespace rave::bus
