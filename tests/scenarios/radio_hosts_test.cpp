// SPDX-License-Identifier: Apache-2.0
// Two hosts, each a process of `rave run`, whose robots talk over real UDP sockets.
#include <arpa/inet.h>
#include <sys/socket.h>

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

  void write_scenario(const std::string& name, double x_m, int own_port, int other_port) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / (name + ".yaml"))
        << "name: " << name << "\nduration_s: 4\nrobots:\n  - name: " << name
        << "\n    pose: {x_m: " << x_m << "}\n    robot:\n"
        << "      body: {shapes: [{disc_radius_m: 0.13, z_m: [0, 0.15]}]}\n"
        << "      transmitters:\n        - name: wlan\n          driver: udp_transmitter\n"
        << "          params: {port: " << own_port << ", peers: '127.0.0.1:" << other_port << "'}\n"
        << "      communicators:\n        - {name: flock, driver: radio, transmitter: wlan, "
           "params: "
           "{range_m: 3}}\n"
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

  void run_both(double apart_m) {
    const int left = free_port();
    const int right = free_port();
    write_scenario("left", 0, left, right);
    write_scenario("right", apart_m, right, left);
    std::FILE* const one = start("left");
    std::FILE* const other = start("right");
    ASSERT_TRUE(one != nullptr && other != nullptr);
    finish(one);
    finish(other);
  }
};

TEST_F(RadioHosts, HearEachOtherWithinTheRange) {
  run_both(2.5);
  for (const char* name : {"left", "right"}) {
    const auto radio = radio_of(name);
    EXPECT_EQ(radio["sent"], 40) << name;
    EXPECT_GT(radio["delivered"], 0) << name;
    EXPECT_EQ(radio["delivered"], radio["from_devices"]["heard"]) << name;
    EXPECT_EQ(radio["lost"]["range"], 0) << name;
    EXPECT_EQ(radio["transmitters"][0]["transmitter"], "wlan");
  }
}

TEST_F(RadioHosts, DoNotHearEachOtherBeyondIt) {
  run_both(3.5);
  for (const char* name : {"left", "right"}) {
    const auto radio = radio_of(name);
    EXPECT_EQ(radio["delivered"], 0) << name;
    EXPECT_GT(radio["lost"]["range"], 0) << name;
  }
}

}  // namespace
}  // namespace rave::tests
