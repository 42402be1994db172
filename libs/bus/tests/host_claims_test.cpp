// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/host_claims.hpp"

#include <gtest/gtest.h>

namespace rave::bus {
namespace {

TEST(HostClaims, TheFirstHasTheHostUntilItIsLost) {
  HostClaims claims(3);
  EXPECT_TRUE(claims.claim(1, 0xa));
  EXPECT_TRUE(claims.claim(1, 0xa));
  EXPECT_TRUE(claims.claim(2, 0xb));
  const Status second = claims.claim(1, 0xb);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message,
            "host 1 is already served by process 000000000000000a, so 000000000000000b is refused; "
            "stop one of them, or give it another host");
  EXPECT_EQ(claims.claim(3, 0xa).error().message, "host 3 is not one of the 3 of the scenario");
  claims.release(0xa);
  EXPECT_TRUE(claims.claim(1, 0xb));
  EXPECT_FALSE(claims.claim(1, 0xa));
  EXPECT_FALSE(claims.claim(2, 0xa)) << "host 2 is not that of the lost process";
}

}  // namespace
}  // namespace rave::bus
