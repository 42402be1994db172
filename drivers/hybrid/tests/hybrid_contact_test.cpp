// SPDX-License-Identifier: Apache-2.0
#include "hybrid_contact.hpp"

#include "fusing.hpp"

namespace rave {
namespace {

using Contact = testing::Fusing<HybridContact>;

std::vector<float> touching(const std::vector<ContactReading>& readings) {
  std::vector<float> bearings;
  for (const ContactReading& reading : readings) {
    bearings.push_back(reading.touching != 0 ? reading.bearing_rad : -9);
  }
  return bearings;
}

TEST(HybridContact, EitherHalfTouches) {
  Contact fusing;
  ASSERT_TRUE(fusing.start());
  using Readings = std::vector<ContactReading>;
  const Readings none{{0, 0}};
  EXPECT_EQ(touching(fusing.fuse(none, none)), (std::vector<float>{-9}));
  EXPECT_EQ(touching(fusing.fuse(Readings{{1, 0.5F}}, none)), (std::vector<float>{0.5F}));
  EXPECT_EQ(touching(fusing.fuse(none, Readings{{1, 2}})), (std::vector<float>{2}));
  // Both: one reading, and the side is that of the real contact.
  EXPECT_EQ(touching(fusing.fuse(Readings{{1, 0.5F}}, Readings{{1, 2}})),
            (std::vector<float>{0.5F}));
}

TEST(HybridContact, AHalfThatSaysNothingLeavesTheOther) {
  Contact fusing;
  ASSERT_TRUE(fusing.start());
  using Readings = std::vector<ContactReading>;
  EXPECT_EQ(touching(fusing.fuse(Readings{}, Readings{{1, 2}})), (std::vector<float>{2}));
  EXPECT_EQ(touching(fusing.fuse(Readings{{1, 0.5F}}, Readings{})), (std::vector<float>{0.5F}));
  EXPECT_TRUE(fusing.fuse(Readings{}, Readings{}).empty());
}

TEST(HybridContact, OfSeveralBumpersOneThatIsFreeTakesTheVirtualContact) {
  Contact fusing(3);
  ASSERT_TRUE(fusing.start());
  using Readings = std::vector<ContactReading>;
  EXPECT_EQ(touching(fusing.fuse(Readings{{1, 0.5F}, {0, -0.5F}}, Readings{{1, 2}})),
            (std::vector<float>{0.5F, 2}));
  EXPECT_EQ(touching(fusing.fuse(Readings{{1, 0.5F}, {1, -0.5F}}, Readings{{1, 2}})),
            (std::vector<float>{0.5F, -0.5F, 2}));
}

}  // namespace
}  // namespace rave
