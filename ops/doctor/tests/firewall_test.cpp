// SPDX-License-Identifier: Apache-2.0
// What rules of a packet filter, as nft prints them, do to our packets.
#include <gtest/gtest.h>

#include "rave/doctor/checks.hpp"

namespace rave::doctor {
namespace {

constexpr const char* kUdpOf =
    R"({"match":{"op":"%","left":{"payload":{"protocol":"udp","field":"dport"}},"right":$}})";

std::string udp(const std::string& right, const std::string& op = "==") {
  std::string text = kUdpOf;
  text.replace(text.find('%'), 1, op);
  text.replace(text.find('$'), 1, right);
  return text;
}

std::string rule(const std::string& parts, const std::string& chain = "in") {
  return R"({"rule":{"family":"inet","table":"t","chain":")" + chain + R"(","expr":[)" + parts +
         "]}}";
}

std::string chain(const std::string& policy) {
  return R"({"chain":{"family":"inet","table":"t","name":"in","type":"filter","hook":"input","prio":0,"policy":")" +
         policy + "\"}}";
}

const std::string kMore = R"({"chain":{"family":"inet","table":"t","name":"more"}})";
const std::string kDrop = R"({"drop":null})";
const std::string kAccept = R"({"accept":null})";
const std::string kEstablished =
    R"({"match":{"op":"in","left":{"ct":{"key":"state"}},"right":["established","related"]}},)";

Finding check(const std::vector<std::string>& entries, std::string_view interface = "eth0") {
  std::string text = R"({"nftables":[{"metainfo":{}})";
  for (const std::string& entry : entries) text += "," + entry;
  return check_ruleset(text + "]}", 0, interface);
}

TEST(Firewall, WithoutRulesNothingIsDropped) {
  EXPECT_EQ(check({}).verdict, Verdict::kGood);
  EXPECT_EQ(check({}).what, "nothing drops UDP 7400 to 7649");
  EXPECT_EQ(check({chain("accept"), rule(udp("53") + "," + kDrop)}).verdict, Verdict::kGood);
}

TEST(Firewall, ARuleThatDropsAPart) {
  const Finding finding =
      check({chain("accept"), rule(udp(R"({"range":[7410,7500]})") + "," + kDrop)});
  EXPECT_EQ(finding.verdict, Verdict::kProblem);
  EXPECT_EQ(finding.what, "the chain `inet t in` drops UDP to ports 7410 to 7500");
  EXPECT_EQ(finding.mend, "sudo nft insert rule inet t in udp dport 7400-7649 accept");
  const std::string set = R"({"set":[53,{"range":[7400,7402]}]})";
  const std::string reject = R"({"counter":{"packets":0}},{"reject":{"type":"icmpx"}})";
  EXPECT_EQ(check({chain("accept"), rule(udp(set) + "," + reject)}).what,
            "the chain `inet t in` drops UDP to ports 7400 to 7402");
  EXPECT_EQ(check({chain("accept"), rule(udp("7649", ">=") + "," + kDrop)}).what,
            "the chain `inet t in` drops UDP to port 7649");
}

TEST(Firewall, APolicyThatDropsWhatNobodyLetsIn) {
  EXPECT_EQ(check({chain("drop"), rule(kEstablished + kAccept)}).verdict, Verdict::kProblem);
  EXPECT_EQ(check({chain("drop"), rule(udp(R"({"range":[7400,7649]})") + "," + kAccept)}).verdict,
            Verdict::kGood);
  EXPECT_EQ(check({chain("drop"), rule(udp(R"({"range":[7400,7640]})") + "," + kAccept)}).what,
            "the chain `inet t in` drops UDP to ports 7641 to 7649");
}

TEST(Firewall, RulesForOneInterface) {
  const std::string lo = R"({"match":{"op":"==","left":{"meta":{"key":"iifname"}},"right":"lo"}},)";
  const std::vector<std::string> rules = {chain("drop"), rule(lo + kAccept)};
  EXPECT_EQ(check(rules, "lo").verdict, Verdict::kGood);
  EXPECT_EQ(check(rules, "eth0").verdict, Verdict::kProblem);
  const std::string eth =
      R"({"match":{"op":"!=","left":{"meta":{"key":"iifname"}},"right":"eth*"}},)";
  EXPECT_EQ(check({chain("accept"), rule(eth + kDrop)}, "eth3").verdict, Verdict::kGood);
}

TEST(Firewall, WhatCannotBeJudgedIsAdvice) {
  const std::string chance =
      R"({"match":{"op":"<","left":{"numgen":{"mode":"random","mod":100}},"right":10}},)";
  const Finding finding = check({chain("accept"), rule(chance + kDrop)});
  EXPECT_EQ(finding.verdict, Verdict::kAdvice);
  EXPECT_EQ(finding.what,
            "the chain `inet t in` has a rule that may drop UDP to ports 7400 to 7649");
  const std::string friends =
      R"({"match":{"op":"==","left":{"payload":{"protocol":"ip","field":"saddr"}},"right":"10.0.0.1"}},)";
  EXPECT_EQ(check({chain("drop"), rule(friends + kAccept)}).verdict, Verdict::kAdvice);
}

TEST(Firewall, OtherProtocolsDoNotCount) {
  const std::string tcp =
      R"({"match":{"op":"==","left":{"payload":{"protocol":"tcp","field":"dport"}},"right":7400}},)";
  EXPECT_EQ(check({chain("accept"), rule(tcp + kDrop)}).verdict, Verdict::kGood);
  const std::string l4 =
      R"({"match":{"op":"==","left":{"meta":{"key":"l4proto"}},"right":"udp"}},)";
  EXPECT_EQ(check({chain("accept"), rule(l4 + kDrop)}).verdict, Verdict::kProblem);
}

TEST(Firewall, ChainsThatCallOthers) {
  const std::string jump = R"({"jump":{"target":"more"}})";
  const std::string back = R"({"return":null})";
  EXPECT_EQ(check({chain("accept"), kMore, rule(jump), rule(kDrop, "more")}).verdict,
            Verdict::kProblem);
  EXPECT_EQ(
      check({chain("accept"), kMore, rule(jump), rule(back, "more"), rule(kDrop, "more")}).verdict,
      Verdict::kGood);
  // For ever in a circle.
  EXPECT_EQ(
      check({chain("accept"), kMore, rule(jump), rule(jump, "more"), rule(jump, "more")}).verdict,
      Verdict::kGood);
}

TEST(Firewall, WhatIsNoListOfRules) {
  EXPECT_EQ(check_ruleset("", 0, "lo").what, "this is not what `nft -j list ruleset` prints");
  EXPECT_EQ(check_ruleset("{\"nftables\":7}", 0, "lo").verdict, Verdict::kUnknown);
  EXPECT_EQ(check_ruleset(std::string(100'000, '['), 0, "lo").what,
            "the list of rules is nested too deeply");
}

}  // namespace
}  // namespace rave::doctor
