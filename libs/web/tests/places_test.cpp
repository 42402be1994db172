// SPDX-License-Identifier: Apache-2.0
// Who has many connections keeps nobody else out.
#include "places.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace rave::web {
namespace {

using Rank = Caller::Rank;

struct FakeLink : Link {
  void cut() override { is_cut = true; }
  bool is_cut = false;
};

class ConnectionPlacesTest : public testing::Test {
 protected:
  FakeLink& come(const std::string& address) {
    FakeLink& link = links_.emplace_back();
    places_.add(link, address);
    return link;
  }
  FakeLink& come(const std::string& address, const Caller& caller) {
    FakeLink& link = come(address);
    places_.name(link, caller);
    return link;
  }
  std::deque<FakeLink> links_;
  ConnectionPlaces places_{8, 4};
};

TEST_F(ConnectionPlacesTest, OfWhoHasTheMostTheOldestGoes) {
  const FakeLink& other = come("10.0.0.2");
  const FakeLink& first = come("10.0.0.1");
  for (int i = 0; i < 6; ++i) come("10.0.0.1");
  const FakeLink& newcomer = come("10.0.0.3");
  EXPECT_TRUE(first.is_cut);
  EXPECT_FALSE(other.is_cut);
  EXPECT_FALSE(newcomer.is_cut);
  for (int i = 0; i < 100; ++i) come("10.0.0.1");
  EXPECT_FALSE(other.is_cut);
  EXPECT_FALSE(newcomer.is_cut);
  EXPECT_EQ(places_.size(), 8U);
}

TEST_F(ConnectionPlacesTest, ASessionHasFewAndASuperUserIsNotCut) {
  const Caller eve{"s1", "eve"};
  const Caller boss{"s2", "boss", Rank::kAlways};
  const FakeLink& kept = come("127.0.0.1", boss);
  const FakeLink& first = come("127.0.0.1", eve);
  for (int i = 0; i < 3; ++i) come("127.0.0.1", eve);
  EXPECT_FALSE(first.is_cut);
  come("127.0.0.1", eve);
  EXPECT_TRUE(first.is_cut);
  EXPECT_EQ(places_.size(), 5U);
  for (int i = 0; i < 100; ++i) come("127.0.0.1", eve);
  for (int i = 0; i < 100; ++i) come("127.0.0.1");
  EXPECT_FALSE(kept.is_cut);
  places_.remove(kept);
  EXPECT_EQ(places_.all().size(), 7U);
}

class SocketPlacesTest : public testing::Test {
 protected:
  /// How many more WebSockets find room; they stay.
  std::size_t fill(const Caller& caller, const std::string& address) {
    std::size_t count = 0;
    for (; places_.refusal(caller, address).empty(); ++count) {
      taken_.emplace_back(places_, caller, address);
    }
    return count;
  }
  const ServerOptions options_ = [] {
    ServerOptions options;
    options.sockets = 100;
    options.sockets_per_session = 5;
    options.sockets_per_user = 8;
    options.sockets_per_address = 20;
    options.sockets_per_network = 30;
    options.reserve = 10;
    return options;
  }();
  SocketPlaces places_{options_};
  std::deque<SocketPlaces::Place> taken_;
};

TEST_F(SocketPlacesTest, LimitsOfASessionAndAUserComeFirst) {
  EXPECT_EQ(fill({"s1", "eve"}, "127.0.0.1"), 5U);
  EXPECT_EQ(places_.refusal({"s1", "eve"}, "127.0.0.1"), "too many pages of this session are open");
  EXPECT_EQ(fill({"s2", "eve"}, "127.0.0.1"), 3U);
  EXPECT_EQ(places_.refusal({"s3", "eve"}, "127.0.0.1"), "too many pages of this user are open");
  EXPECT_EQ(fill({"s4", "ben"}, "127.0.0.1"), 5U);
  // Of two places that are given back, two are free.
  taken_.pop_front();
  EXPECT_TRUE(taken_.front().leave());
  EXPECT_EQ(fill({"s1", "eve"}, "127.0.0.1"), 2U);
}

TEST_F(SocketPlacesTest, AnAddressHasFewerThanItsNetworkAndThisMachineHasNoSuchLimit) {
  EXPECT_EQ(fill({}, "2001:db8::1"), 20U);
  EXPECT_EQ(fill({}, "2001:db8::2"), 10U) << "the same network";
  EXPECT_EQ(fill({}, "10.0.0.1"), 20U);
  EXPECT_EQ(places_.refusal({}, "10.0.0.1"), "too many pages are open from this address");
  EXPECT_EQ(fill({}, "127.0.0.1"), 50U);
  EXPECT_EQ(places_.refusal({}, "127.0.0.1"), "too many pages are open");
}

TEST_F(SocketPlacesTest, AReserveIsKeptForWhoStopsAndForSuperUsers) {
  const Caller stopper{"s1", "ben", Rank::kMayStop};
  const Caller boss{"s2", "boss", Rank::kAlways};
  EXPECT_EQ(fill({}, "10.0.0.1"), 20U);
  EXPECT_EQ(fill(stopper, "10.0.0.1"), 5U);
  EXPECT_EQ(fill(boss, "10.0.0.1"), 5U) << "of the address";
  EXPECT_EQ(fill({}, "127.0.0.1"), 70U);
  EXPECT_TRUE(places_.refusal({"s3", "cleo", Rank::kMayStop}, "127.0.0.1").empty());
  EXPECT_EQ(fill(boss, "127.0.0.1"), 10U) << "without a limit of a session";
}

TEST_F(SocketPlacesTest, FewMayTakeTheirTimeToLeave) {
  for (int i = 0; i < 100; ++i) taken_.emplace_back(places_, Caller{}, "127.0.0.1");
  int leaving = 0;
  for (auto& place : taken_) leaving += place.leave() ? 1 : 0;
  EXPECT_EQ(leaving, 64);
  EXPECT_TRUE(taken_.front().leave()) << "it leaves already";
  EXPECT_EQ(fill({}, "127.0.0.1"), 100U);
}

}  // namespace
}  // namespace rave::web
