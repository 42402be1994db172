// SPDX-License-Identifier: Apache-2.0
// HostResults that go from one process to another.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "made_host_results.hpp"
#include "rave/bus_testing/peer_process.hpp"
#include "rave/protocol/host_results.hpp"

namespace rave::lock_step {
namespace {

using bus::testing::eventually;
using bus::testing::PeerProcess;
using bus::testing::TestDomain;
using testing::kMuch;
using testing::made_host_results;
using testing::whole_line;

constexpr const char* kProgram = "peer_lock_step";
/// Nobody is taken for dead before the test is over.
constexpr const char* kLongLease = "lease_s=600";
/// Than a second and one write, which may take half a second; however busy the machine is.
constexpr std::chrono::seconds kFarMoreThanTold{60};

/// A host of the test's own process.
struct Host {
  std::unique_ptr<bus::Bus> bus;
  std::optional<HostResultsSender> sender;

  explicit Host(const TestDomain& domain) {
    auto opened = bus::Bus::open(domain.config("host"));
    if (!opened) return;
    bus = *std::move(opened);
    if (!sender.emplace().open(*bus)) sender.reset();
  }
  [[nodiscard]] bool meets(std::size_t managers) const {
    return sender && eventually([&] { return sender->readers() == managers; });
  }
  /// It is told to wait a second for somebody who does not take them.
  void expect_gives_up(std::span<const std::byte> bytes) {
    const auto began = std::chrono::steady_clock::now();
    const Status sent = sender->send(3, bytes, from_seconds(1));
    EXPECT_LT(std::chrono::steady_clock::now() - began, kFarMoreThanTold);
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error().code, ErrorCode::kTimeout);
    EXPECT_EQ(sent.error().message, "the environment manager did not accept them within 1 s");
  }
};

TEST(HostResultsProcesses, SendMoreThanAWriterMayHold) {
  const TestDomain domain;
  PeerProcess manager(domain, "collect", "manager", {}, kProgram);
  ASSERT_EQ(manager.line(), "ready");
  Host host(domain);
  ASSERT_TRUE(host.meets(1));
  const auto bytes = made_host_results(3, kMuch);
  const Status sent = host.sender->send(3, bytes, from_seconds(bus::testing::kPatience_s));
  EXPECT_TRUE(sent) << sent.error().text();
  EXPECT_EQ(manager.line(), whole_line(3, bytes));
  EXPECT_EQ(manager.end(), 0);
}

TEST(HostResultsProcesses, AManagerThatStandsHoldsUpNobodyForLongerThanTold) {
  const TestDomain domain;
  PeerProcess stuck(domain, "collect", "stuck", {kLongLease}, kProgram);
  PeerProcess manager(domain, "collect", "manager", {}, kProgram);
  ASSERT_EQ(stuck.line(), "ready");
  ASSERT_EQ(manager.line(), "ready");
  Host host(domain);
  ASSERT_TRUE(host.meets(2));
  PeerProcess other(domain, "deliver", "other", {"managers=2", "host=4", "size=300000"}, kProgram);
  ASSERT_EQ(other.line(), "met");
  stuck.pause();
  other.poke();
  const auto bytes = made_host_results(3, 1'000'000);
  host.expect_gives_up(bytes);
  EXPECT_EQ(other.line(), "the environment manager did not accept them within 2 s");
  // Who goes on has what all hosts know.
  const std::set<std::string> has = {manager.line(), manager.line()};
  const std::set<std::string> expected = {whole_line(3, bytes),
                                          whole_line(4, made_host_results(4, 300'000))};
  EXPECT_EQ(has, expected);
  EXPECT_EQ(manager.end(), 0);
}

TEST(HostResultsProcesses, AManagerThatStandsIsNotWaitedForWithWhatIsMoreThanAWriterMayHold) {
  const TestDomain domain;
  PeerProcess stuck(domain, "collect", "stuck", {kLongLease}, kProgram);
  ASSERT_EQ(stuck.line(), "ready");
  Host host(domain);
  ASSERT_TRUE(host.meets(1));
  stuck.pause();
  host.expect_gives_up(made_host_results(3, kMuch));
}

TEST(HostResultsProcesses, AManagerThatDiesMeanwhileIsNotWaitedFor) {
  const TestDomain domain;
  PeerProcess manager(domain, "collect", "manager", {"lease_s=10"}, kProgram);
  ASSERT_EQ(manager.line(), "ready");
  Host host(domain);
  ASSERT_TRUE(host.meets(1));
  const auto bytes = made_host_results(3, kMuch);
  // It is missed when its lease has run out, in the middle of what it should have taken.
  manager.kill();
  // A patience that no test survives: it is the loss of the manager that ends this.
  const Status sent = host.sender->send(3, bytes, from_seconds(3600));
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, ErrorCode::kState) << sent.error().text();
  EXPECT_EQ(sent.error().message, "the environment manager was lost before it had received them");
}

TEST(HostResultsProcesses, WithoutAManagerAreNotSent) {
  const TestDomain domain;
  Host host(domain);
  ASSERT_TRUE(host.meets(0));
  const Status sent = host.sender->send(3, made_host_results(3, kMuch), from_seconds(3600));
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, ErrorCode::kState);
  EXPECT_EQ(sent.error().message, "there is no environment manager to receive them");
}

TEST(HostResultsProcesses, OfAHostThatDiesDoNotKeepThoseOfAnother) {
  const TestDomain domain;
  PeerProcess manager(domain, "collect", "manager", {}, kProgram);
  ASSERT_EQ(manager.line(), "ready");
  {
    PeerProcess other(domain, "deliver", "other",
                      {"managers=1", "host=4", fmt::format("size={}", kMuch)}, kProgram);
    ASSERT_EQ(other.line(), "met");
    other.poke();
    // Somewhere in the middle; where does not matter.
    other.kill();
  }
  Host host(domain);
  ASSERT_TRUE(host.meets(1));
  const auto bytes = made_host_results(3, kMuch);
  const Status sent = host.sender->send(3, bytes, from_seconds(bus::testing::kPatience_s));
  EXPECT_TRUE(sent) << sent.error().text();
  // Those of the other come whole or not at all.
  const std::string others = whole_line(4, made_host_results(4, kMuch));
  std::string line = manager.line();
  if (line == others) line = manager.line();
  EXPECT_EQ(line, whole_line(3, bytes));
  EXPECT_EQ(manager.end(), 0);
}

}  // namespace
}  // namespace rave::lock_step
