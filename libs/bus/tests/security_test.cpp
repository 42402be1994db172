// SPDX-License-Identifier: Apache-2.0
// With certificates: those who have them of the same set talk, the others get nothing.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "rave/bus/local_transport.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"
#include "rave/keys/key_set.hpp"

namespace rave::bus::testing {
namespace {

constexpr std::int64_t kDay_s = 86'400;

/// Sets of keys in a folder of their own.
class Security : public ::testing::Test {
 public:
  ~Security() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 protected:
  Security() {
    std::string name = std::filesystem::temp_directory_path() / "rave-bus-XXXXXX";
    if (::mkdtemp(name.data()) != nullptr) folder_ = name;
  }

  /// Two members, `left` and `right`, for ten days from `now_s` on.
  void make_set(const std::string& name, std::int64_t now_s = std::time(nullptr)) {
    const Status made = keys::make_key_set({folder_ / name, "lab", 10, {"left", "right"}, now_s});
    ASSERT_TRUE(made) << made.error().text();
  }
  /// Ready to join with the keys of `set/right`; without any if it is empty.
  [[nodiscard]] BusConfig config(const std::string& set) const {
    BusConfig config = domain_.config();
    if (!set.empty()) config.security = folder_ / set / "right";
    return config;
  }
  /// Another process that shows `count` obstacles, with the keys of `set/left`.
  [[nodiscard]] std::unique_ptr<PeerProcess> furnish(const std::string& set, int count) const {
    std::vector<std::string> words = {"count=" + std::to_string(count)};
    if (!set.empty()) words.push_back("security=" + (folder_ / set / "left").string());
    return std::make_unique<PeerProcess>(domain_, "furnish", "peer-" + set, words);
  }
  /// Joins, and expects all obstacles of the one writer that has `count`, and none of others.
  void expect_only(const std::string& set, std::uint32_t count) const {
    const auto bus = Bus::open(config(set));
    ASSERT_TRUE(bus) << bus.error().text();
    auto reader = Reader<Obstacle>::create(**bus);
    std::size_t heard = 0;
    EXPECT_TRUE(eventually([&] {
      heard += reader->take([&](const Obstacle& obstacle) { EXPECT_LT(obstacle.id, count); });
      return heard >= count;
    })) << set;
    EXPECT_EQ(heard, count) << set;
    EXPECT_EQ(reader->writers(), 1U) << set;
  }
  [[nodiscard]] std::string refusal(const std::string& set) const {
    const auto bus = Bus::open(config(set));
    return bus ? "none" : bus.error().message;
  }

  TestDomain domain_;
  std::filesystem::path folder_;
};

TEST_F(Security, MembersOfASetTalkAndTheOthersGetNothing) {
  make_set("ours");
  make_set("theirs");
  const auto outsider = furnish("", 7);
  const auto foreigner = furnish("theirs", 5);
  const auto member = furnish("ours", 2);
  for (PeerProcess* peer : {outsider.get(), foreigner.get(), member.get()}) {
    ASSERT_EQ(peer->line(), "ready");
  }
  expect_only("ours", 2);
  expect_only("theirs", 5);
  expect_only("", 7);
}

TEST_F(Security, AMemberThatWasAddedTakesPart) {
  make_set("ours");
  ASSERT_TRUE(keys::add_members(folder_ / "ours", {"late"}, 0, std::time(nullptr)));
  const auto member = furnish("ours", 3);
  ASSERT_EQ(member->line(), "ready");
  std::filesystem::remove_all(folder_ / "ours/right");
  std::filesystem::rename(folder_ / "ours/late", folder_ / "ours/right");
  expect_only("ours", 3);
}

TEST_F(Security, NothingGoesBesideTheCertificates) {
  make_set("ours");
  PeerProcess peer(domain_, "follow", "peer",
                   {"host=1", "security=" + (folder_ / "ours/left").string()});
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(config("ours"));
  ASSERT_TRUE(bus) << bus.error().text();
  auto worlds = Writer<WorldStep>::create(**bus);
  auto reports = Reader<HostReport>::create(**bus);
  ASSERT_TRUE(worlds && reports);
  // Nobody has the addresses of the local transport.
  EXPECT_TRUE(LocalSocket::open({domain_.run, (*bus)->writer(), 0}));
  EXPECT_TRUE(
      LocalSocket::open({domain_.run, (*bus)->writer(), topic_of<HostReport>().local_transport}));
  int heard = 0;
  WorldStep world{};
  world.epoch = 1;
  EXPECT_TRUE(eventually([&] {
    ++world.step;
    EXPECT_TRUE(worlds->write(world));
    reports->take([&](const HostReport& report, const dds_sample_info_t& info) {
      ++heard;
      EXPECT_STREQ(report.text, "dds");
      EXPECT_NE(info.publication_handle, 0U);
    });
    return heard >= 20;
  }));
  EXPECT_EQ(peer.end(), 0);
}

/// What a process sends to everybody whom there may be, until it is not seen any more or has sent
/// some: its packets at a port where DDS would look for another process of this machine.
std::string heard_by_strangers(const BusConfig& config) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  // Discovery of process number 40 of a machine: 7400 + 250 * domain + 10 + 2 * number
  // (DDSI 9.6.1.1).
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  address.sin_port = ::htons(static_cast<std::uint16_t>(7400 + 250 * config.domain + 10 + 2 * 40));
  EXPECT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const auto bus = Bus::open(config);
  EXPECT_TRUE(bus) << bus.error().text();
  std::string heard;
  for (int packets = 0; packets < 2; ++packets) {
    pollfd watch{socket, POLLIN, 0};
    if (::poll(&watch, 1, kPatience_s * 1000) <= 0) break;
    std::string packet(65'536, '\0');
    const auto size = ::recv(socket, packet.data(), packet.size(), 0);
    heard += packet.substr(0, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }
  ::close(socket);
  return heard;
}

TEST_F(Security, WhoHasNoCertificateReadsNeitherTheNameNorTheRun) {
  make_set("ours");
  for (const bool secured : {false, true}) {
    BusConfig config = this->config(secured ? "ours" : "");
    config.participant = "secret laboratory";
    const std::string heard = heard_by_strangers(config);
    ASSERT_NE(heard.find("RTPS"), std::string::npos) << "nothing was heard";
    EXPECT_EQ(heard.find("secret laboratory") != std::string::npos, !secured);
    EXPECT_EQ(heard.find(config.run.text()) != std::string::npos, !secured);
    EXPECT_EQ(heard.find("test_bus_security") != std::string::npos, !secured);
  }
}

TEST_F(Security, MembersKnowOneAnotherByName) {
  make_set("ours");
  PeerProcess peer(domain_, "idle", "left one", {"security=" + (folder_ / "ours/left").string()});
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(config("ours"));
  ASSERT_TRUE(bus) << bus.error().text();
  std::vector<BusEvent> events;
  const auto event_of = [&](EventKind kind) {
    for (BusEvent& event : (*bus)->take_events()) events.push_back(std::move(event));
    return std::ranges::any_of(events, [kind](const BusEvent& event) {
      return event.kind == kind && event.participant == "left one" && event.writer != 0;
    });
  };
  EXPECT_TRUE(eventually([&] { return event_of(EventKind::kParticipantAppeared); }));
  const auto known = (*bus)->processes();
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known.front().run, domain_.run);
  peer.kill();
  EXPECT_TRUE(eventually([&] { return event_of(EventKind::kParticipantLost); }));
}

TEST_F(Security, WhoseCertificateHasExpiredIsTold) {
  make_set("old", std::time(nullptr) - 11 * kDay_s);
  const std::string reason = refusal("old");
  EXPECT_NE(reason.find("certificate has expired"), std::string::npos) << reason;
  EXPECT_NE(reason.find("right"), std::string::npos) << reason;
}

TEST_F(Security, WhoseCertificateIsNotYetValidIsTold) {
  make_set("early", std::time(nullptr) + 3 * kDay_s);
  const std::string reason = refusal("early");
  EXPECT_NE(reason.find("certificate is not yet valid"), std::string::npos) << reason;
}

TEST_F(Security, DocumentsThatDoNotFitAreNamed) {
  make_set("ours");
  std::ofstream(folder_ / "ours/right/governance.p7s") << "nothing";
  const std::string reason = refusal("ours");
  EXPECT_NE(reason.find("permissions"), std::string::npos) << reason;
}

/// What a member may do is in its permissions, which only the authority can sign.
TEST_F(Security, MembersHaveTheTopicsOfRaveAndRosAndNoOthers) {
  make_set("ours");
  const BusConfig config = this->config("ours");
  const dds_entity_t domain = dds_create_domain(config.domain, cyclone_xml(config).c_str());
  ASSERT_GT(domain, 0);
  const dds_entity_t participant = dds_create_participant(config.domain, nullptr, nullptr);
  ASSERT_GT(participant, 0);
  /// Whether one can write a topic in a partition, or in none.
  const auto can_write = [&](const char* topic_name, const char* partition) {
    const dds_entity_t topic =
        dds_create_topic(participant, topic_of<Obstacle>().type, topic_name, nullptr, nullptr);
    if (topic < 0) return false;
    const Qos qos(dds_create_qos());
    if (partition != nullptr) dds_qset_partition1(qos.get(), partition);
    const dds_entity_t publisher = dds_create_publisher(participant, qos.get(), nullptr);
    return dds_create_writer(publisher, topic, nullptr, nullptr) > 0;
  };
  EXPECT_TRUE(can_write("rave/obstacle", "rave/0123"));
  EXPECT_TRUE(can_write("rt/scan", nullptr));
  EXPECT_TRUE(can_write("rt/cart/scan", "cart"));
  EXPECT_TRUE(can_write("ros_discovery_info", nullptr));
  EXPECT_FALSE(can_write("rave/obstacle", nullptr));
  EXPECT_FALSE(can_write("rave/obstacle", "elsewhere"));
  EXPECT_FALSE(can_write("chatter", nullptr));
  dds_delete(domain);
}

}  // namespace
}  // namespace rave::bus::testing
