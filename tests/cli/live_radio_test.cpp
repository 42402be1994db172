// SPDX-License-Identifier: Apache-2.0
// Robots of several hosts that talk in real time, in real processes: who heard what of whom stands
// in the records of the hosts.
#include <algorithm>
#include <csignal>
#include <cstring>
#include <numeric>

#include "live_listener.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// What the robots of one host said and heard, by name.
struct Talk {
  std::map<std::string, Numbers> said;                              ///< By sender.
  std::map<std::pair<std::string, std::string>, Numbers> heard;     ///< By receiver and sender.
  std::map<std::pair<std::string, std::string>, double> latency_s;  ///< The mean.
};

Talk talk_of(const std::filesystem::path& path) {
  Talk talk;
  const auto reader = record::McapReader::open(path);
  EXPECT_TRUE(reader) << (reader ? "" : reader.error().text());
  if (!reader) return talk;
  const auto run = record::read_run_info(*reader);
  EXPECT_TRUE(run);
  if (!run) return talk;
  record::MessageFilter filter;
  for (const auto& channel : reader->channels()) {
    if (channel.topic == record::topic::kRadio) filter.channels.push_back(channel.id);
  }
  if (filter.channels.empty()) return talk;
  const auto name = [&](RobotId robot) { return run->robots[robot.value()].name; };
  auto cursor = reader->messages(filter);
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    const auto step = record::decode_radio((*message)->bytes);
    EXPECT_TRUE(step);
    if (!step) break;
    for (const record::RadioPacket& packet : step->items) {
      std::uint32_t number = 0;
      EXPECT_EQ(packet.payload.size(), sizeof number);
      std::memcpy(&number, packet.payload.data(), sizeof number);
      if (!packet.delivered) {
        talk.said[name(packet.from)].push_back(number);
        continue;
      }
      const auto pair = std::pair(name(packet.to), name(packet.from));
      talk.heard[pair].push_back(number);
      talk.latency_s[pair] += 1e-9 * static_cast<double>(packet.received_ns - packet.sent_ns);
    }
  }
  for (auto& [pair, sum_s] : talk.latency_s) sum_s /= static_cast<double>(talk.heard[pair].size());
  return talk;
}

Numbers up_to(std::uint32_t last) {
  Numbers all(last);
  std::iota(all.begin(), all.end(), 1U);
  return all;
}

class LiveRadio : public SharedWorld {
 protected:
  void begin(const std::string& what, const std::string& scenario,
             std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--plugins", RAVE_BINARY_DIR "/tests/plugins/radio"});
    start(what == "env" ? "env" : what, what == "env" || what == "run" ? what : "robot", scenario,
          std::move(more));
  }
  [[nodiscard]] Talk talk(const std::string& run) const {
    return talk_of(folder(run) + "/run.mcap");
  }
};

const std::map<std::string, std::vector<std::string>> kRobots = {
    {"one", {"a0", "a1", "a2", "a3"}}, {"two", {"b0", "b1", "b2"}}, {"three", {"c0", "c1", "c2"}}};

TEST_F(LiveRadio, TenThousandMessagesReachAllHostsOnceAndInTheirOrder) {
  begin("run", "talk.yaml");
  ASSERT_EQ(end_of("run"), 0) << console("run");
  std::map<std::string, Talk> talks;
  std::map<std::string, Numbers> said;
  std::size_t messages = 0;
  for (const auto& [host, robots] : kRobots) {
    talks[host] = talk("run/hosts/" + host);
    for (const std::string& robot : robots) {
      said[robot] = talks[host].said[robot];
      messages += said[robot].size();
      EXPECT_EQ(said[robot], up_to(static_cast<std::uint32_t>(said[robot].size()))) << robot;
    }
  }
  EXPECT_GE(messages, 9'900U) << "ten robots, 100 times a second, 10 s";
  double worst_s = 0;
  for (auto& [host, robots] : kRobots) {
    for (const std::string& to : robots) {
      for (const auto& [from, numbers] : said) {
        if (from == to) continue;
        EXPECT_EQ((talks[host].heard[{to, from}]), numbers) << from << " to " << to;
        worst_s = std::max(worst_s, talks[host].latency_s[{to, from}]);
      }
    }
    const auto result = this->result("run/hosts/" + host);
    EXPECT_EQ(result["lost_packets"], 0) << host;
    EXPECT_EQ(result["dropped_packets"], 0) << host;
    EXPECT_EQ(result["radio"]["delivered"], result["radio"]["addressed"]) << host;
  }
  RecordProperty("mean_latency_of_the_slowest_link_s", std::to_string(worst_s));
}

TEST_F(LiveRadio, WhenAHostIsKilledTheOthersHearEachOther) {
  const bus::RunId id = bus::RunId::random();
  const std::vector<std::string> run = {"--run", id.text(), "--duration", "6"};
  const auto with = [&](const std::string& host) {
    std::vector<std::string> words = run;
    words.insert(words.end(), {"--host", host});
    return words;
  };
  begin("env", "talk.yaml", run);
  for (const char* const host : {"one", "two", "three"}) begin(host, "talk.yaml", with(host));
  const auto listener = LiveListener::open(id, apart());
  ASSERT_TRUE(listener) << listener.error().text();
  wait_until(
      [&] {
        (*listener)->listen();
        const auto& worlds = (*listener)->worlds;
        return !worlds.empty() && worlds.back().time_ns > 2'500'000'000;
      },
      "they have talked for a while");
  signal("two", SIGKILL);
  EXPECT_EQ(end_of("two"), -1);
  wait_for_line("env", "host `two` is gone");
  for (const char* const who : {"one", "three", "env"}) end_of(who);
  std::map<std::string, Talk> talks;
  for (const char* const host : {"one", "three"}) talks[host] = talk(host);
  for (const auto& [here, there] : {std::pair("one", "three"), std::pair("three", "one")}) {
    for (const std::string& from : kRobots.at(there)) {
      // What was said at the very end has not arrived everywhere.
      Numbers said = talks[there].said[from];
      ASSERT_GT(said.size(), 300U) << from;
      said.resize(said.size() - 50);
      for (const std::string& to : kRobots.at(here)) {
        Numbers heard = talks[here].heard[{to, from}];
        ASSERT_GE(heard.size(), said.size()) << from << " to " << to;
        heard.resize(said.size());
        EXPECT_EQ(heard, said) << from << " to " << to;
      }
    }
  }
}

/// Beside a flood; sanitizers leave the hosts of this machine little time to speak.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t kLeastSaid = 60;
#else
constexpr std::size_t kLeastSaid = 300;
#endif

TEST_F(LiveRadio, WhoFloodsIsLimitedAndNamedAndTheOthersHearEachOther) {
  begin("run", "flood.yaml");
  ASSERT_EQ(end_of("run"), 0) << console("run");
  EXPECT_NE(console("run/hosts/one").find("robot `flooder` sends more than"), std::string::npos)
      << console("run/hosts/one");
  EXPECT_EQ(console("run/hosts/two").find("sends more than"), std::string::npos);
  EXPECT_GT(result("run/hosts/one")["withheld_packets"], 10'000);
  const std::map<std::string, std::string> host_of = {
      {"a0", "one"}, {"b0", "two"}, {"c0", "three"}};
  std::map<std::string, Talk> talks;
  for (const auto& [robot, host] : host_of) talks[robot] = talk("run/hosts/" + host);
  for (const auto& [to, host] : host_of) {
    for (const auto& [from, other] : host_of) {
      if (from == to) continue;
      Numbers said = talks[from].said[from];
      ASSERT_GT(said.size(), kLeastSaid) << from;
      said.resize(said.size() - 50);
      Numbers heard = talks[to].heard[{to, from}];
      ASSERT_GE(heard.size(), said.size()) << from << " to " << to;
      heard.resize(said.size());
      EXPECT_EQ(heard, said) << from << " to " << to;
    }
    EXPECT_GT((talks[to].heard[{to, "flooder"}].size()), 1'000U) << "limited, not shut out";
  }
}

}  // namespace
}  // namespace rave::cli_test
