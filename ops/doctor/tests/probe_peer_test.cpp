// SPDX-License-Identifier: Apache-2.0
// One doctor visits another, with real packets between two addresses of this machine.
#include "rave/doctor/probe_peer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "rave/doctor/ports.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

constexpr const char* kHere = "127.0.0.1";
constexpr const char* kThere = "127.0.0.2";

class ProbePeerTest : public ::testing::Test {
 public:
  ~ProbePeerTest() override {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

 protected:
  void listen(std::uint32_t domain, std::function<std::int64_t()> clock = wall_ns) {
    Listener::Options options;
    options.address = kThere;
    options.about = about(domain);
    options.clock = std::move(clock);
    auto opened = Listener::open(std::move(options));
    ASSERT_TRUE(opened) << opened.error().message;
    listener_ = *std::move(opened);
    thread_ = std::thread([this] { listener_->serve([this] { return stopping_.load(); }); });
  }
  static About about(std::uint32_t domain) {
    bus::BusConfig config;
    config.domain = domain;
    config.multicast = bus::Multicast::kDiscovery;
    return about_here(config, 42);
  }
  [[nodiscard]] ProbeResult go(std::uint32_t domain) const {
    ProbeOptions options;
    options.address = kHere;
    options.domain = domain;
    options.multicast = true;
    return probe_peer(kThere, options);
  }
  static const Finding* find(const Findings& findings, std::string_view check) {
    const auto found = std::ranges::find(findings, check, &Finding::check);
    return found == findings.end() ? nullptr : &*found;
  }

  /// Others may test at the same time.
  const std::uint32_t domain_ = static_cast<std::uint32_t>(1 + ::getpid() % 90);
  std::unique_ptr<Listener> listener_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
};

TEST_F(ProbePeerTest, AllIsWellBetweenTwoAddressesOfOneMachine) {
  listen(domain_);
  const ProbeResult result = go(domain_);
  ASSERT_EQ(result.port, ProbeResult::PortState::kOpen) << result.why;
  EXPECT_EQ(result.about, listener_->about());
  EXPECT_NE(result.about.discovery_port, 0);
  EXPECT_TRUE(result.discovery_open);
  EXPECT_TRUE(result.data_open);
  EXPECT_EQ(result.multicast_there, true);
  EXPECT_EQ(result.multicast_back, true);
  ASSERT_TRUE(result.clock);
  EXPECT_LT(std::abs(result.clock->offset.seconds()), 0.5);
  ASSERT_EQ(result.sizes.size(), 7U);
  for (const ProbeResult::Size& size : result.sizes)
    EXPECT_TRUE(size.there && size.back) << size.bytes;
  const Findings findings = judge(result, about(domain_));
  for (const Finding& finding : findings)
    EXPECT_EQ(finding.verdict, Verdict::kGood) << finding.what;
  EXPECT_EQ(find(findings, "sizes")->what, "127.0.0.2: datagrams up to 64000 bytes arrive");
}

TEST_F(ProbePeerTest, NobodyListens) {
  const ProbeResult result = go(domain_);
  EXPECT_EQ(result.port, ProbeResult::PortState::kRefused);
  const Findings findings = judge(result, about(domain_));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].what,
            "127.0.0.2: the machine is reachable, but `rave doctor --listen` does not run on it");
  EXPECT_EQ(
      findings[0].mend,
      fmt::format("rave doctor --listen --interface 127.0.0.2 --domain {}    # there", domain_));
}

TEST_F(ProbePeerTest, AnotherDomain) {
  listen(domain_ + 1);
  const ProbeResult result = go(domain_);
  EXPECT_EQ(result.other_domain, domain_ + 1);
  const Findings findings = judge(result, about(domain_));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].check, "domain");
  EXPECT_EQ(findings[0].mend,
            fmt::format("--domain {}    # here, or the other number there", domain_ + 1));
}

TEST_F(ProbePeerTest, AClockThatIsWrong) {
  listen(domain_, [] { return wall_ns() + 3600 * std::int64_t{1'000'000'000}; });
  const ProbeResult result = go(domain_);
  ASSERT_TRUE(result.clock);
  EXPECT_NEAR(result.clock->offset.seconds(), 3600, 0.5);
  const Findings findings = judge(result, about(domain_));
  ASSERT_NE(find(findings, "clock"), nullptr);
  EXPECT_EQ(find(findings, "clock")->verdict, Verdict::kProblem);
  EXPECT_TRUE(find(findings, "clock")
                  ->what.starts_with("127.0.0.2: its clock differs from the clock here by +36"))
      << find(findings, "clock")->what;
  EXPECT_EQ(find(findings, "clock")->mend, "sudo timedatectl set-ntp true    # on both");
}

TEST_F(ProbePeerTest, ASecondListenerIsRefused) {
  listen(domain_);
  Listener::Options options;
  options.address = kThere;
  options.about = about(domain_);
  const auto second = Listener::open(std::move(options));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message,
            fmt::format("another `rave doctor --listen` already uses 127.0.0.2, UDP port {}",
                        doctor_port(domain_)));
}

TEST_F(ProbePeerTest, GarbageIsNotAnsweredAndNothingIsMultiplied) {
  listen(domain_);
  auto socket = Socket::bind({kHere, 0});
  ASSERT_TRUE(socket);
  const Place there{kThere, doctor_port(domain_)};
  Probe greedy;
  greedy.number = 1;
  greedy.want = 60'000;
  // Shorter than what would answer it.
  ASSERT_TRUE(socket->send(write_probe(greedy), there));
  ASSERT_TRUE(socket->send("RTPS garbage", there));
  greedy.number = 2;
  ASSERT_TRUE(socket->send(write_probe(greedy, 2000), there));
  std::vector<char> bytes(kLargestProbe);
  const auto received = socket->receive(bytes, 10'000);
  ASSERT_TRUE(received && *received);
  EXPECT_EQ((*received)->size, 2000U) << "no longer than the question";
  EXPECT_EQ(parse_probe({bytes.data(), (*received)->size})->number, 2U);
}

ProbeResult open_result() {
  ProbeResult result;
  result.peer = "10.0.0.2";
  result.port = ProbeResult::PortState::kOpen;
  result.about = {"there", "0.1.0", 42, 0, "none", "", "", 7410, 7411, true};
  result.discovery_open = true;
  result.data_open = true;
  return result;
}
const About kSelf = {"here", "0.1.0", 42, 0, "none", "", "", 0, 0, false};

/// The findings that are not good, as lines.
std::string trouble(const ProbeResult& result, const About& here = kSelf) {
  std::string text;
  for (const Finding& finding : judge(result, here)) {
    if (finding.verdict == Verdict::kGood) continue;
    text +=
        std::string(to_string(finding.verdict)) + " " + finding.what + " | " + finding.mend + "\n";
  }
  return text;
}

TEST(Judge, OfOneKindOnBothSidesThereIsNothingToSay) { EXPECT_EQ(trouble(open_result()), ""); }

TEST(Judge, OtherBuilds) {
  ProbeResult result = open_result();
  result.about.version = "0.2.0";
  EXPECT_EQ(trouble(result),
            "advice 10.0.0.2: it has RAVE 0.2.0, and this machine 0.1.0 | install the same version "
            "on both machines\n");
  result.about.interface_stamp = 7;
  EXPECT_TRUE(trouble(result).starts_with(
      "problem 10.0.0.2: it has RAVE 0.2.0 with other interfaces, and this machine 0.1.0 | "));
}

TEST(Judge, OtherAuthorities) {
  ProbeResult result = open_result();
  result.about.authority = "3F:09:AA:BB:CC:DD:EE:FF:00";
  EXPECT_EQ(trouble(result),
            "problem 10.0.0.2: it has those of 3F:09:AA:BB:CC:DD, and this machine no certificates "
            "| rave keys new SET here there    # one set for all; then --security on both\n");
}

TEST(Judge, AFirewallThatLetsAPartThrough) {
  ProbeResult result = open_result();
  result.data_open = false;
  EXPECT_EQ(trouble(result),
            "problem 10.0.0.2: UDP port 7411 cannot be reached, but 7402 can: a firewall blocks "
            "some ports of the domain | sudo nft insert rule inet filter input udp dport 7400-7649 "
            "accept    # there\n");
}

TEST(Judge, MulticastOneWay) {
  ProbeResult result = open_result();
  About here = kSelf;
  result.about.multicast = here.multicast = "data";
  result.multicast_there = true;
  result.multicast_back = false;
  EXPECT_EQ(trouble(result, here),
            "problem 10.0.0.2: its multicast packets do not arrive here | --multicast none --peer "
            "10.0.0.2"
            "    # a list of all machines, on each\n");
}

TEST(Judge, FragmentsThatGetLost) {
  ProbeResult result = open_result();
  result.sizes = {{1400, true, true}, {1472, true, true}, {4000, false, false}};
  EXPECT_TRUE(trouble(result).starts_with(
      "problem 10.0.0.2: datagrams of 4000 bytes and more do not arrive: packet fragments"))
      << trouble(result);
}

TEST(Judge, SilenceAndNoWay) {
  ProbeResult result;
  result.peer = "10.0.0.2";
  EXPECT_TRUE(trouble(result).starts_with("problem 10.0.0.2: no answer")) << trouble(result);
  result.port = ProbeResult::PortState::kNoWay;
  result.why = "send: Network is unreachable";
  EXPECT_TRUE(trouble(result).starts_with(
      "problem 10.0.0.2: there is no route to it (send: Network is unreachable) | ip route get"))
      << trouble(result);
}

}  // namespace
}  // namespace rave::doctor
