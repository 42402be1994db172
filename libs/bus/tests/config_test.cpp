// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/config.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rave::bus {
namespace {

BusConfig good() {
  BusConfig config;
  config.participant = "host one";
  config.run = RunId::random();
  return config;
}

std::string reason(const BusConfig& config) {
  const Status status = validate(config);
  return status ? "accepted" : status.error().message;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(BusConfig, StaysOnThisMachineByDefault) {
  const BusConfig config = good();
  EXPECT_EQ(reason(config), "accepted");
  EXPECT_TRUE(config.loopback());
  const std::string xml = cyclone_xml(config);
  EXPECT_TRUE(has(xml, "<NetworkInterface address=\"127.0.0.1\"/>"));
  EXPECT_TRUE(has(xml, "<AllowMulticast>false</AllowMulticast>"));
  EXPECT_TRUE(has(xml, "<Peer address=\"127.0.0.1\"/>"));
  EXPECT_TRUE(has(xml, "<ParticipantIndex>auto</ParticipantIndex>"));
  EXPECT_TRUE(has(xml, "<MaxAutoParticipantIndex>63</MaxAutoParticipantIndex>"));
  // Not the second after which a silent process counts as lost: see BusConfig::forget.
  EXPECT_TRUE(has(xml, "<LeaseDuration>30000ms</LeaseDuration>"));
  EXPECT_TRUE(has(xml, "<SPDPInterval>800ms</SPDPInterval>"));
  EXPECT_TRUE(has(xml, "<WhcAdaptive>false</WhcAdaptive>"));
}

// With the defaults the memory of an idle process grows for an hour: see internals().
TEST(BusConfig, KeepsReceiveBuffersSmall) {
  const std::string xml = cyclone_xml(good());
  EXPECT_TRUE(has(xml, "<Sizing><ReceiveBufferSize>256KiB</ReceiveBufferSize></Sizing>")) << xml;
  EXPECT_TRUE(has(xml, "<SocketReceiveBufferSize max=\"8MiB\"/>")) << xml;
  EXPECT_TRUE(has(xml, "<MultipleReceiveThreads>false</MultipleReceiveThreads>")) << xml;
}

TEST(BusConfig, NamesInterfacesAndPeers) {
  BusConfig config = good();
  config.interface = "eth0";
  config.peers = {"10.0.0.1", "robot-b.local"};
  EXPECT_EQ(reason(config), "accepted");
  const std::string xml = cyclone_xml(config);
  EXPECT_TRUE(has(xml, "<NetworkInterface name=\"eth0\"/>"));
  EXPECT_TRUE(has(xml, "<Peer address=\"10.0.0.1\"/><Peer address=\"robot-b.local\"/>"));
  EXPECT_FALSE(has(xml, "FragmentSize"));
}

TEST(BusConfig, SaysWhatMulticastIsFor) {
  BusConfig config = good();
  config.interface = "eth0";
  config.multicast = Multicast::kDiscovery;
  EXPECT_EQ(reason(config), "accepted");
  EXPECT_TRUE(has(cyclone_xml(config), "<AllowMulticast>spdp</AllowMulticast>"));
  config.multicast = Multicast::kData;
  EXPECT_TRUE(has(cyclone_xml(config), "<AllowMulticast>true</AllowMulticast>"));
  EXPECT_FALSE(has(cyclone_xml(config), "multicast=\"true\""));
  config.interface = "lo";
  EXPECT_TRUE(has(cyclone_xml(config), "<NetworkInterface name=\"lo\" multicast=\"true\"/>"));
}

TEST(BusConfig, NamesItsDomainWhereItsNumberInTheProcessIsAnother) {
  BusConfig config = good();
  config.domain = 17;
  EXPECT_FALSE(has(cyclone_xml(config), "ExternalDomainId"));
  config.beside = true;
  EXPECT_TRUE(has(cyclone_xml(config), "<ExternalDomainId>17</ExternalDomainId>"));
}

TEST(BusConfig, WritesTextsSoThatTheyStayTexts) {
  BusConfig config = good();
  config.tag = "a<b>&\"c\"";
  EXPECT_EQ(reason(config), "accepted");
  EXPECT_TRUE(has(cyclone_xml(config), "<Tag>a&lt;b&gt;&amp;&quot;c&quot;</Tag>"));
}

TEST(BusConfig, TakesTheVariableOnlyIfToldTo) {
  ::setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain/></CycloneDDS>", 1);
  BusConfig config = good();
  EXPECT_FALSE(has(cyclone_xml(config), "<Domain/>"));
  config.cyclone_settings = std::getenv("CYCLONEDDS_URI");
  EXPECT_TRUE(cyclone_xml(config).ends_with(",<CycloneDDS><Domain/></CycloneDDS>"));
  ::unsetenv("CYCLONEDDS_URI");
}

TEST(BusConfig, OfManyProcessesHostsLookForHubsAlone) {
  BusConfig config = good();
  config.domain = 2;
  config.max_processes = 3;
  config.reach = Reach::kHubs;
  const std::string host = cyclone_xml(config);
  // Behind 114 places of two ports each.
  EXPECT_TRUE(has(host, "<Peers><Peer address=\"127.0.0.1:8138\"/>")) << host;
  EXPECT_TRUE(has(host, "<Peer address=\"127.0.0.1:8148\"/></Peers>")) << host;
  EXPECT_TRUE(has(host, "<ParticipantIndex>auto</ParticipantIndex>")) << host;
  config.reach = Reach::kHub;
  const std::string hub = cyclone_xml(config, 5);
  EXPECT_TRUE(has(hub, "<ParticipantIndex>119</ParticipantIndex>")) << hub;
  EXPECT_TRUE(has(hub, "<Peers><Peer address=\"127.0.0.1:7910\"/>")) << hub;
  EXPECT_TRUE(has(hub, "<Peer address=\"127.0.0.1:7914\"/><Peer address=\"127.0.0.1:8138\"/>"))
      << hub;
  config.multicast = Multicast::kDiscovery;
  EXPECT_TRUE(has(cyclone_xml(config), "<ParticipantIndex>auto</ParticipantIndex>"))
      << "multicast finds all anyway";
  config = good();
  config.reach = Reach::kHubs;
  config.max_processes = 115;
  EXPECT_EQ(reason(config), "max_processes: found 115, expected 1 to 114, in addition to hubs");
}

TEST(BusConfig, RefusesWhatCannotWork) {
  BusConfig config = good();
  config.participant = "";
  EXPECT_EQ(reason(config), "participant: expected a name");
  config = good();
  config.participant = std::string(65, 'x');
  EXPECT_EQ(reason(config), "participant: 65 bytes; expected at most 64");
  config = good();
  config.run = {};
  EXPECT_EQ(reason(config), "run: expected an id, the same for all processes of a run");
  config.anonymous = true;
  EXPECT_TRUE(validate(config)) << "who only looks belongs to no run";
  config = good();
  config.domain = 231;
  EXPECT_EQ(reason(config), "domain: found 231, expected 0 to 230");
  config = good();
  config.max_processes = 120;
  EXPECT_EQ(reason(config), "max_processes: found 120, expected 1 to 119");
  config = good();
  config.lease = Duration{1};
  EXPECT_TRUE(has(reason(config), "lease: found 1e-09 s, expected 0.1 s to 3600 s"));
  config = good();
  config.interface = "${HOME}";
  EXPECT_EQ(reason(config), "interface: control characters and `$` are not allowed");
  config = good();
  config.participant =
      "host\xc2\x9b"
      "2J";
  EXPECT_EQ(reason(config), "participant: control characters and `$` are not allowed");
  config = good();
  config.interface = "192.168.0.1";
  EXPECT_TRUE(has(reason(config), "peers: without multicast no process is found on 192.168.0.1"));
}

TEST(BusConfig, LooksForEachCertificate) {
  BusConfig config = good();
  const auto folder = std::filesystem::temp_directory_path() / ("rave-" + config.run.text());
  std::filesystem::create_directory(folder);
  config.security = folder;
  const std::string missing = "security: there is no " + (folder / "identity_ca.pem").string();
  EXPECT_EQ(reason(config), missing);
  std::filesystem::create_directory(folder / "ca");
  EXPECT_EQ(reason(config),
            missing + "; this is a set of keys, name the folder of one member in it");
  for (const char* const name : {"identity_ca.pem", "identity.pem", "identity_key.pem",
                                 "permissions_ca.pem", "governance.p7s", "permissions.p7s"}) {
    std::ofstream(folder / name) << "x";
  }
  const std::filesystem::path key = folder / "identity_key.pem";
  std::filesystem::permissions(key, std::filesystem::perms(0644));
  EXPECT_EQ(reason(config), "other users can read the private key `" + key.string() +
                                "`; run `chmod 600 " + key.string() + "`");
  std::filesystem::permissions(key, std::filesystem::perms(0600));
  EXPECT_EQ(reason(config), "accepted");
  EXPECT_TRUE(
      has(cyclone_xml(config), "<PrivateKey>file:" + (folder / "identity_key.pem").string()));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rave::bus
