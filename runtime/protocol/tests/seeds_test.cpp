// SPDX-License-Identifier: Apache-2.0
// The seeds of the fuzzers of this folder are made by the code that ships: of an older type they
// would not come past the first check. RAVE_WRITE_SEEDS=1 in the environment writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "example_messages.hpp"
#include "rave/base/file.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"
#include "rave/bus_testing/sample_messages.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::lock_step::testing {
namespace {

const std::filesystem::path kFolder = RAVE_SOURCE_DIR "/runtime/protocol/tests";

class ProtocolSeeds : public ::testing::Test {
 protected:
  ProtocolSeeds() {
    const sim::HostReport report = example_report();
    ReportMessage report_message;
    bus::HostReport& wire = report_message.fill(report, 6, 77);
    wire.writer = 1;
    add("corpus_lock_step/report", 0, wire);
    const sim::WorldStep step = example_world();
    const sim::AuthorityState authority = example_authority();
    WorldMessage step_message;
    auto filled = step_message.fill(step, authority, 9);
    EXPECT_TRUE(filled) << filled.error().text();
    if (filled) {
      (*filled)->writer = 1;
      add("corpus_lock_step/world", 1, static_cast<const bus::WorldStep&>(**filled));
    }
    bus::World world{};
    world.writer = 1;
    bus::testing::RobotArrays robots(3, 1);
    robots.lend(world.robots);
    add("corpus_real_time/world", 1, world);
    const bus::testing::NewBox box(4);
    add("corpus_real_time/obstacle", 2, box.sample);
    const sim::SentPackets& sent = report.sent;
    const auto bytes = sent.bytes_of(sent.packets[0]);
    bus::Packet packet = real_time::packet_of(sent.packets[0], bytes, 12, Duration{100});
    packet.writer = 1;
    add("corpus_real_time/radio", 0, packet);
  }

  std::map<std::string, std::string> all_;

 private:
  /// The first byte tells the fuzzer what comes.
  template <class Message>
  void add(const std::string& name, char first, const Message& message) {
    const std::vector<std::byte> bytes = bus::testing::encode(message);
    bus::testing::Decoded<Message> decoded;
    EXPECT_TRUE(decoded.decode(bytes) && bus::validate(decoded.sample())) << name;
    std::string seed(1, first);
    for (const std::byte b : bytes) seed += static_cast<char>(b);
    all_[name] = seed;
  }
};

TEST_F(ProtocolSeeds, AreWhatTheCodeMakes) {
  for (const auto& [name, seed] : all_) {
    if (std::getenv("RAVE_WRITE_SEEDS") != nullptr) {
      std::ofstream(kFolder / name, std::ios::binary) << seed;
    }
    const auto kept = read_file(kFolder / name);
    ASSERT_TRUE(kept) << kept.error().text();
    EXPECT_TRUE(*kept == seed) << name << " is of an older type; see the top of this file";
  }
}

}  // namespace
}  // namespace rave::lock_step::testing
