// SPDX-License-Identifier: Apache-2.0
// Searches that end when they have found what is wanted. Their patience is longer than that of the
// test.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"
#include "rave/keys/key_set.hpp"
#include "rave/watch/observer.hpp"
#include "rave/watch/scenario_runs.hpp"

namespace rave::watch {
namespace {

using bus::testing::TestDomain;

constexpr Duration kForEver{86'400'000'000'000};

std::unique_ptr<bus::Bus> join(bus::BusConfig config) {
  config.beside = true;
  auto bus = bus::Bus::open(config);
  EXPECT_TRUE(bus) << bus.error().text();
  return *std::move(bus);
}

/// With certificates a process is seen before it is known what it is.
TEST(Searches, ARunWithKeysIsFoundAsSoonAsItSaysWhichItIs) {
  std::string name = std::filesystem::temp_directory_path() / "rave-searches-XXXXXX";
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = name;
  ASSERT_TRUE(
      keys::make_key_set({folder / "set", "lab", 10, {"host", "asker"}, std::time(nullptr)}));
  const TestDomain domain;
  bus::BusConfig config = domain.config("host");
  config.security = folder / "set/host";
  const auto host = join(config);
  config.participant = "asker";
  config.security = folder / "set/asker";
  config.beside = true;
  const auto found = find_runs(config, kForEver, [&domain](const std::vector<FoundRun>& runs) {
    return !runs.empty() && runs.front().run == domain.run;
  });
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->front().processes, std::vector<std::string>{"host"});
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

TEST(Searches, RunsAreFoundByWhatTheyRunTheNewestFirst) {
  const TestDomain domain;
  std::vector<std::unique_ptr<bus::Bus>> hosts;
  std::vector<bus::Writer<bus::HostInfo>> infos;
  const auto begin = [&](std::uint64_t number, std::int64_t started_ns) {
    bus::BusConfig config = domain.config("host");
    config.run = bus::RunId::random();
    hosts.push_back(join(config));
    infos.push_back(*bus::Writer<bus::HostInfo>::create(*hosts.back()));
    bus::HostInfo info{};
    bus::put_text(info.name, "host-1");
    bus::put_text(info.version, "1");
    info.scenario = number;
    info.started_ns = started_ns;
    EXPECT_TRUE(infos.back().write(info));
    return config.run;
  };
  const bus::RunId old = begin(7, 100);
  begin(8, 300);
  const bus::RunId young = begin(7, 200);
  bus::BusConfig config = domain.config("GUI Server");
  config.beside = true;
  std::size_t wanted = 0;
  const auto found = find_scenario_runs(config, kForEver, [&wanted](const ScenarioRun& run) {
    return run.number == 7 && ++wanted == 2;
  });
  ASSERT_TRUE(found) << found.error().text();
  std::vector<bus::RunId> sevens;
  for (const ScenarioRun& run : *found) {
    if (run.number == 7) sevens.push_back(run.run);
  }
  EXPECT_EQ(sevens, (std::vector<bus::RunId>{young, old}));
}

}  // namespace
}  // namespace rave::watch
