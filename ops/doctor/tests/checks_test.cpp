// SPDX-License-Identifier: Apache-2.0
// Each check of one machine, on machines as they might be and with what this one has.
#include "rave/doctor/checks.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "rave/doctor/ports.hpp"
#include "rave/keys/key_set.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

Machine lab_machine() {
  Machine machine;
  machine.kernel = "6.1.0-13-amd64";
  machine.interfaces = {{"lo", "127.0.0.1", true, false, true},
                        {"eth0", "192.168.1.7", true, true, false},
                        {"wlan0", "", true, true, false},
                        {"eth1", "10.0.0.7", false, true, false}};
  machine.open_files = 1024;
  machine.receive_buffer_max = 212'992;
  machine.first_handed_out = 32'768;
  machine.last_handed_out = 60'999;
  machine.now_s = 1'800'000'000;
  return machine;
}

bus::BusConfig config_of(std::string interface, std::vector<std::string> peers = {}) {
  bus::BusConfig config;
  config.interface = std::move(interface);
  config.peers = std::move(peers);
  return config;
}

void expect(const Finding& finding, Verdict verdict, std::string_view what, std::string_view mend) {
  EXPECT_EQ(to_string(finding.verdict), to_string(verdict)) << finding.what;
  EXPECT_EQ(finding.what, what);
  EXPECT_EQ(finding.mend, mend);
}

TEST(CheckInterface, OneThatIsNotThereIsNamedWithTheNearest) {
  const Machine machine = lab_machine();
  expect(check_interface(machine, config_of("eht0")), Verdict::kProblem,
         "there is no interface `eht0`; did you mean `eth0`?; there are lo (127.0.0.1), eth0 "
         "(192.168.1.7), eth1 (10.0.0.7)",
         "--interface 192.168.1.7");
  expect(check_interface(machine, config_of("192.168.1.7", {"192.168.1.2"})), Verdict::kGood,
         "eth0 with 192.168.1.7", "");
}

TEST(CheckInterface, DownWithoutAddressOrLoopbackOnly) {
  const Machine machine = lab_machine();
  expect(check_interface(machine, config_of("eth1")), Verdict::kProblem,
         "eth1 is down, or has no cable", "sudo ip link set eth1 up");
  expect(check_interface(machine, config_of("wlan0")), Verdict::kProblem,
         "wlan0 has no IPv4 address", "sudo ip addr add ADDRESS/24 dev wlan0");
  expect(check_interface(machine, config_of("127.0.0.1", {"127.0.0.1", "192.168.1.2"})),
         Verdict::kProblem, "lo reaches only this machine, but other machines are to be found",
         "--interface 192.168.1.7");
  EXPECT_EQ(check_interface(machine, config_of("127.0.0.1", {"127.0.0.1"})).verdict,
            Verdict::kGood);
}

TEST(CheckKernel, OlderThanNeeded) {
  Machine machine = lab_machine();
  EXPECT_EQ(check_kernel(machine).verdict, Verdict::kGood);
  machine.kernel = "5.3.0";
  EXPECT_EQ(check_kernel(machine).verdict, Verdict::kGood);
  machine.kernel = "4.19.0-25";
  expect(check_kernel(machine), Verdict::kProblem,
         "Linux 4.19.0-25 is older than 5.3, which RAVE needs",
         "sudo apt-get install linux-image-amd64 && sudo reboot");
  machine.kernel = "plan9";
  EXPECT_EQ(check_kernel(machine).verdict, Verdict::kUnknown);
}

TEST(CheckLimits, FilesAndBuffers) {
  Machine machine = lab_machine();
  EXPECT_EQ(check_open_files(machine).verdict, Verdict::kGood);
  machine.open_files = 64;
  expect(check_open_files(machine), Verdict::kProblem,
         "a process may open only 64 files; sockets and recordings may need more",
         "ulimit -n 1024");
  expect(check_receive_buffer(machine), Verdict::kAdvice,
         "socket buffers are limited to 208 kB; a world of 10 000 robots needs 600 kB, and packets "
         "that do not fit are lost and sent again",
         "sudo sysctl -w net.core.rmem_max=8388608");
  machine.receive_buffer_max = 8U << 20U;
  EXPECT_EQ(check_receive_buffer(machine).verdict, Verdict::kGood);
  machine.receive_buffer_max.reset();
  EXPECT_EQ(check_receive_buffer(machine).verdict, Verdict::kUnknown);
}

TEST(CheckDomain, PortsOfTheKernel) {
  bus::BusConfig config;
  expect(check_domain(lab_machine(), config), Verdict::kGood, "0: UDP ports 7400 to 7649", "");
  config.domain = 150;
  expect(check_domain(lab_machine(), config), Verdict::kAdvice,
         "150: UDP ports 44900 to 45149; the kernel also gives some of them to other programs "
         "(32768 to 60999)",
         "--domain 0    # on all machines; any domain up to 99");
  config.domain = 99;
  EXPECT_EQ(check_domain(lab_machine(), config).verdict, Verdict::kGood);
  config.domain = 231;
  EXPECT_EQ(check_domain(lab_machine(), config).verdict, Verdict::kProblem);
}

TEST(CheckSettings, WhomTheVariableOfCycloneIsFor) {
  Machine machine = lab_machine();
  EXPECT_EQ(check_cyclone_uri(machine).verdict, Verdict::kGood);
  machine.cyclone_uri = "<CycloneDDS/>,file:///nowhere/cyclone.xml";
  expect(check_cyclone_uri(machine), Verdict::kProblem,
         "CYCLONEDDS_URI names /nowhere/cyclone.xml, which is not a file; programs of ROS 2 do not "
         "start with it",
         "unset CYCLONEDDS_URI");
  machine.cyclone_uri = "<CycloneDDS/>";
  EXPECT_EQ(check_cyclone_uri(machine).verdict, Verdict::kAdvice);
}

TEST(CheckClock, BeforeRave) {
  Machine machine = lab_machine();
  EXPECT_EQ(check_clock(machine).verdict, Verdict::kGood);
  machine.now_s = 3600;
  expect(check_clock(machine), Verdict::kProblem,
         "the clock of this machine is before 2020: certificates are not valid yet",
         "sudo timedatectl set-ntp true");
}

TEST(CheckPeers, NamesThatNobodyKnowsAndListsWithoutThisMachine) {
  const Machine machine = lab_machine();
  std::vector<std::string> found;
  expect(check_peers(machine, config_of("eth0", {"no-such-machine.invalid"}), found),
         Verdict::kProblem, "no address is known for no-such-machine.invalid",
         "getent ahostsv4 no-such-machine.invalid    # name the address instead");
  expect(check_peers(machine, config_of("eth0"), found), Verdict::kProblem,
         "without peers and without multicast, no process is found",
         "--peer ADDRESS    # of each machine that takes part, this one included");
  EXPECT_TRUE(found.empty());
  expect(
      check_peers(machine, config_of("eth0", {"192.168.1.2"}), found), Verdict::kAdvice,
      "192.168.1.2; this machine is not in the list, so its own processes do not find each other",
      "--peer 192.168.1.7");
  EXPECT_EQ(found, std::vector<std::string>{"192.168.1.2"});
  found.clear();
  EXPECT_EQ(check_peers(machine, config_of("eth0", {"192.168.1.2", "192.168.1.7"}), found).verdict,
            Verdict::kGood);
  EXPECT_EQ(found.size(), 1U) << "this machine needs no visit";
  found.clear();
  EXPECT_EQ(check_peers(machine, config_of("127.0.0.1"), found).what, "this machine only");
}

/// A domain in which nothing of this machine is at work, as far as ports tell.
std::uint32_t quiet_domain() {
  const auto first = static_cast<std::uint32_t>(1 + ::getpid() % 80);
  for (std::uint32_t domain = first; domain < first + 20; ++domain) {
    bool quiet = true;
    for (int port = first_port(domain); port <= last_port(domain); ++port) {
      quiet = quiet && Socket::bind({"0.0.0.0", static_cast<std::uint16_t>(port)}).has_value();
    }
    if (quiet) return domain;
  }
  return first;
}

TEST(CheckPorts, FreeTakenByOneAndTakenByAll) {
  bus::BusConfig config;
  config.domain = quiet_domain();
  config.max_processes = 2;
  const int first = discovery_port(config.domain, 0);
  EXPECT_EQ(check_ports(config).what, fmt::format("{} to {} are free", first, first + 3));
  const auto one = Socket::bind({"0.0.0.0", data_port(config.domain, 0)});
  ASSERT_TRUE(one);
  EXPECT_EQ(check_ports(config).what, "1 of 2 are in use by processes; the others are free");
  const auto other = Socket::bind({"0.0.0.0", discovery_port(config.domain, 1)});
  ASSERT_TRUE(other);
  const Finding finding = check_ports(config);
  EXPECT_EQ(finding.verdict, Verdict::kProblem);
  EXPECT_EQ(finding.what, fmt::format("all UDP ports from {} to {} are in use", first, first + 3));
  EXPECT_TRUE(finding.mend.starts_with("sudo ss -ulpn")) << finding.mend;
}

TEST(CheckPorts, OneWhoDoesNotShareThePortOfMulticast) {
  bus::BusConfig config;
  config.domain = quiet_domain();
  const auto greedy = Socket::bind({"0.0.0.0", multicast_port(config.domain)});
  ASSERT_TRUE(greedy);
  const Finding finding = check_ports(config);
  EXPECT_EQ(finding.verdict, Verdict::kProblem);
  EXPECT_TRUE(finding.what.starts_with(
      fmt::format("UDP port {} for multicast is used", multicast_port(config.domain))))
      << finding.what;
}

TEST(CheckOwnWay, RealPacketsOnLoopback) {
  bus::BusConfig config = config_of("lo");
  config.domain = quiet_domain();
  const Finding finding = check_own_way(this_machine(), config);
  EXPECT_EQ(finding.verdict, Verdict::kGood);
  EXPECT_EQ(finding.what,
            fmt::format("127.0.0.1 reaches its own UDP port {}", data_port(config.domain, 0)));
  EXPECT_EQ(check_own_way(lab_machine(), config_of("wlan0")).verdict, Verdict::kUnknown);
}

TEST(CheckMulticast, RealPacketsOnLoopback) {
  bus::BusConfig config = config_of("127.0.0.1");
  config.domain = quiet_domain();
  EXPECT_EQ(check_multicast(this_machine(), config).what, "not used");
  config.multicast = bus::Multicast::kDiscovery;
  const Finding finding = check_multicast(this_machine(), config);
  EXPECT_EQ(finding.verdict, Verdict::kGood) << finding.what;
  EXPECT_EQ(finding.what, fmt::format("239.255.0.1:{} works on lo", multicast_port(config.domain)));
}

TEST(CheckMulticast, AnInterfaceThatDoesNone) {
  Machine machine = lab_machine();
  machine.interfaces[1].multicast = false;
  bus::BusConfig config = config_of("eth0");
  config.multicast = bus::Multicast::kData;
  expect(check_multicast(machine, config), Verdict::kProblem, "eth0 does not support multicast",
         "sudo ip link set eth0 multicast on");
}

class CheckKeys : public ::testing::Test {
 public:
  ~CheckKeys() override { std::filesystem::remove_all(folder_); }

 protected:
  CheckKeys() {
    std::string name = std::filesystem::temp_directory_path() / "rave-doctor-XXXXXX";
    folder_ = ::mkdtemp(name.data());
    static_cast<void>(keys::make_key_set({folder_ / "set", "lab", 100, {"left"}, kMade_s}));
  }
  [[nodiscard]] Finding at(std::int64_t days) const {
    return check_keys(folder_ / "set/left", kMade_s + days * 86'400);
  }

  static constexpr std::int64_t kMade_s = 1'800'000'000;
  std::filesystem::path folder_;
};

TEST_F(CheckKeys, GoodSoonOverOverAndNotYet) {
  EXPECT_EQ(check_keys({}, kMade_s).verdict, Verdict::kGood);
  EXPECT_EQ(at(1).verdict, Verdict::kGood) << at(1).what;
  EXPECT_TRUE(at(1).what.starts_with("left of lab, until 2027-04-")) << at(1).what;
  EXPECT_EQ(at(90).verdict, Verdict::kAdvice) << at(90).what;
  EXPECT_EQ(at(120).verdict, Verdict::kProblem);
  EXPECT_TRUE(at(120).what.starts_with("left expired on 2027-04-")) << at(120).what;
  EXPECT_TRUE(at(-10).what.starts_with("left is not valid before 2027-01-")) << at(-10).what;
}

TEST_F(CheckKeys, MissingMixedUpOpenAndAWholeSet) {
  EXPECT_EQ(check_keys(folder_ / "set", kMade_s).mend,
            "--security " + (folder_ / "set/left").string());
  EXPECT_EQ(check_keys(folder_ / "nowhere", kMade_s).verdict, Verdict::kProblem);
  namespace fs = std::filesystem;
  const fs::path key = folder_ / "set/left/identity_key.pem";
  fs::permissions(key, fs::perms::others_read, fs::perm_options::add);
  EXPECT_TRUE(at(1).what.starts_with("left: other users can read identity_key.pem")) << at(1).what;
  fs::permissions(key, fs::perms::others_read, fs::perm_options::remove);
  ASSERT_TRUE(keys::make_key_set({folder_ / "other", "lab", 100, {"left"}, kMade_s}));
  fs::copy_file(folder_ / "other/left/identity_ca.pem", folder_ / "set/left/identity_ca.pem",
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(at(1).verdict, Verdict::kProblem) << "another authority";
  fs::remove(folder_ / "set/left/permissions.p7s");
  EXPECT_EQ(at(1).what, "left: permissions.p7s is missing");
}

TEST(Findings, AsJsonAndWhetherAllIsWell) {
  Findings findings = {{"kernel", Verdict::kGood, "6.1", ""},
                       {"buffers", Verdict::kAdvice, "small", "sudo more"}};
  EXPECT_TRUE(all_well(findings));
  findings.push_back({"ports", Verdict::kProblem, "taken", "ss"});
  EXPECT_FALSE(all_well(findings));
  EXPECT_EQ(to_json({findings.back()}),
            "{\"rave_doctor\":1,\"well\":false,\"findings\":[{\"check\":\"ports\",\"verdict\":"
            "\"problem\",\"what\":\"taken\",\"mend\":\"ss\"}]}\n");
}

TEST(ThisMachine, KnowsItself) {
  const Machine machine = this_machine();
  ASSERT_NE(machine.find("lo"), nullptr);
  EXPECT_TRUE(machine.has_address("127.0.0.1"));
  EXPECT_EQ(check_kernel(machine).verdict, Verdict::kGood);
  EXPECT_GT(machine.open_files, 0U);
  EXPECT_EQ(check_clock(machine).verdict, Verdict::kGood);
}

}  // namespace
}  // namespace rave::doctor
