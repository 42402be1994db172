// SPDX-License-Identifier: Apache-2.0
// Two hosts, each a process of `rave run`, whose robots talk over real UDP sockets or over DDS.
#include <arpa/inet.h>
#include <sys/socket.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class RadioHosts : public ScenarioTest {
 protected:
  /// A UDP port of the loopback interface that is free now.
  static int free_port() {
    const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(fd, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size), 0);
    ::close(fd);
    return ntohs(address.sin_port);
  }

  static std::string udp(int own_port, int other_port) {
    return "udp_transmitter, params: {port: " + std::to_string(own_port) +
           ", peers: '127.0.0.1:" + std::to_string(other_port) + "'}";
  }
  /// An air of this test alone.
  static std::string dds() {
    return "dds_transmitter, params: {network: test-" + std::to_string(::getpid()) + "}";
  }

  /// Late steps are no matter: several processes share a machine that runs other tests as well.
  void write_scenario(const std::string& name, double x_m, const std::string& transmitter,
                      const std::string& radio = {}) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / (name + ".yaml"))
        << "name: " << name << "\nduration_s: 4\nmax_missed_pct: 100\nrobots:\n  - name: " << name
        << "\n    pose: {x_m: " << x_m << "}\n    robot:\n"
        << "      body: {shapes: [{disc_radius_m: 0.13, z_m: [0, 0.15]}]}\n"
        << "      transmitters:\n        - {name: wlan, driver: " << transmitter << "}\n"
        << "      communicators:\n        - {name: flock, driver: radio, transmitter: wlan, "
           "params: "
        << "{range_m: 3" << radio << "}}\n"
        << "      actuators: [{name: wheels, driver: differential_drive}]\n"
        << "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
        << "      program: {driver: flock, period_s: 0.1, params: {cruise_mps: 0.01}}\n";
  }

  std::FILE* start(const std::string& name) const {
    const std::string command = std::string(RAVE_BINARY_DIR) + "/bin/rave run " +
                                (folder_ / (name + ".yaml")).string() + " --output " +
                                (folder_ / name).string() + " 2>&1";
    return ::popen(command.c_str(), "r");
  }

  static void finish(std::FILE* process) {
    std::string text;
    char room[512];
    while (const std::size_t size = std::fread(room, 1, sizeof room, process)) {
      text.append(room, size);
    }
    EXPECT_EQ(::pclose(process), 0) << text;
  }

  [[nodiscard]] nlohmann::json radio_of(const std::string& name) const {
    std::ifstream file(folder_ / name / "result.json");
    const auto result = nlohmann::json::parse(file);
    EXPECT_TRUE(result["hash"].is_null());
    return result["radio"];
  }

  void run_both() {
    std::FILE* const one = start("left");
    std::FILE* const other = start("right");
    ASSERT_TRUE(one != nullptr && other != nullptr);
    finish(one);
    finish(other);
  }
  void run_over_udp(double apart_m, const std::string& radio = {}) {
    const int left = free_port();
    const int right = free_port();
    write_scenario("left", 0, udp(left, right), radio);
    write_scenario("right", apart_m, udp(right, left), radio);
    run_both();
  }
  void run_over_dds(double apart_m, const std::string& radio = {}) {
    write_scenario("left", 0, dds(), radio);
    write_scenario("right", apart_m, dds(), radio);
    run_both();
  }

  void expect_both_hear() const {
    for (const char* name : {"left", "right"}) {
      const auto radio = radio_of(name);
      EXPECT_EQ(radio["sent"], 40) << name;
      EXPECT_GT(radio["delivered"], 0) << name;
      EXPECT_EQ(radio["delivered"], radio["from_devices"]["heard"]) << name;
      EXPECT_EQ(radio["lost"]["range"], 0) << name;
      EXPECT_EQ(radio["transmitters"][0]["transmitter"], "wlan");
    }
  }
  void expect_neither_hears() const {
    for (const char* name : {"left", "right"}) {
      const auto radio = radio_of(name);
      EXPECT_EQ(radio["delivered"], 0) << name;
      EXPECT_GT(radio["lost"]["range"], 0) << name;
    }
  }
};

TEST_F(RadioHosts, HearEachOtherWithinTheRange) {
  run_over_udp(2.5);
  expect_both_hear();
}

TEST_F(RadioHosts, DoNotHearEachOtherBeyondIt) {
  run_over_udp(3.5);
  expect_neither_hears();
}

TEST_F(RadioHosts, HearEachOtherOverDdsWithinTheRange) {
  run_over_dds(2.5);
  expect_both_hear();
  EXPECT_EQ(radio_of("left")["transmitters"][0]["refused"], 0);
}

TEST_F(RadioHosts, DoNotHearEachOtherOverDdsBeyondIt) {
  run_over_dds(3.5);
  expect_neither_hears();
}

TEST_F(RadioHosts, LossAndByteRateHoldOverDds) {
  // 32 bytes ten times a second are 320 B/s: half of them leave in time.
  run_over_dds(1, ", loss_probability: 0.5, byte_rate: 160, queue_bytes: 256");
  for (const char* name : {"left", "right"}) {
    const auto radio = radio_of(name);
    EXPECT_EQ(radio["offered"], 40) << name;
    EXPECT_GE(radio["sent"], 15) << name;
    EXPECT_LE(radio["sent"], 20) << name;
    EXPECT_GT(radio["lost"]["chance"], 0) << name;
    EXPECT_EQ(radio["delivered"].get<int>() + radio["lost"]["chance"].get<int>(),
              radio["from_devices"]["heard"])
        << name;
  }
}

TEST_F(RadioHosts, AFlockOfThreeProcessesAlignsOverDds) {
  std::filesystem::create_directories(folder_);
  const char* const names[] = {"red", "green", "blue"};
  for (int part = 0; part < 3; ++part) {
    std::ofstream(folder_ / (std::string(names[part]) + ".yaml"))
        << "name: " << names[part]
        << "\nduration_s: 12\nmax_missed_pct: 100\nrobots:\n  - name: " << names[part]
        << "\n    poses: [[0, " << part << ", " << 90 * part << "], [1, " << part << ", "
        << 90 * part << "]]\n    robot:\n"
        << "      body: {shapes: [{disc_radius_m: 0.05, z_m: [0, 0.15]}]}\n"
        << "      transmitters:\n        - {name: air, driver: " << dds() << "}\n"
        << "      communicators: [{name: flock, driver: radio, transmitter: air}]\n"
        << "      actuators: [{name: wheels, driver: differential_drive}]\n"
        << "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
        << "      program: {driver: flock, period_s: 0.1, params: {alignment: 4, cohesion: 0.2}}\n";
  }
  std::vector<std::FILE*> processes;
  for (const char* name : names) processes.push_back(start(name));
  for (std::FILE* process : processes) finish(process);
  double x = 0;
  double y = 0;
  for (const char* name : names) {
    std::ifstream file(folder_ / name / "result.json");
    const auto result = nlohmann::json::parse(file);
    EXPECT_GT(result["radio"]["from_devices"]["heard"], 300) << name;
    EXPECT_EQ(result["radio"]["transmitters"].size(), 2U);
    EXPECT_LE(result["radio"]["transmitters"][0]["others"], 2) << "one participant per process";
    for (const auto& robot : result["robots"]) {
      const double yaw_rad = robot["final_pose"]["yaw_rad"];
      x += std::cos(yaw_rad) / 6;
      y += std::sin(yaw_rad) / 6;
    }
  }
  EXPECT_GT(std::hypot(x, y), 0.8) << "they set out in three directions";
}

}  // namespace
}  // namespace rave::tests
