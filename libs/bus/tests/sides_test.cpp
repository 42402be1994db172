// SPDX-License-Identifier: Apache-2.0
// Who exchanges messages with whom: a manager and monitors with hosts, and not with each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

/// Names of the processes whose ends match those of a bus, by topic: `host-1 reads rave/run`.
std::set<std::string> matches_of(Bus& bus, std::map<std::string, std::set<std::string>>& known,
                                 const std::string& name) {
  for (const BusEvent& event : bus.take_events()) {
    if (event.kind == EventKind::kReaderAppeared)
      known[name].insert(event.participant + " reads " + event.topic);
    if (event.kind == EventKind::kWriterAppeared)
      known[name].insert(event.participant + " writes " + event.topic);
  }
  return known[name];
}

/// Both ends of topics that go each way.
struct AllEnds {
  Writer<RunState> runs;
  Reader<RunState> runs_in;
  Writer<HostState> states;
  Reader<HostState> states_in;
  Writer<LastObstacle> obstacles;
  Reader<LastObstacle> obstacles_in;

  static AllEnds on(Bus& bus) {
    return {*Writer<RunState>::create(bus),     *Reader<RunState>::create(bus),
            *Writer<HostState>::create(bus),    *Reader<HostState>::create(bus),
            *Writer<LastObstacle>::create(bus), *Reader<LastObstacle>::create(bus)};
  }
};

TEST(Sides, ManagerAndMonitorsMatchHostsAndNotEachOther) {
  const TestDomain domain;
  const auto open = [&](const char* name, Side side) {
    BusConfig config = domain.config();
    config.participant = name;
    config.side = side;
    config.beside = true;
    auto bus = Bus::open(config);
    EXPECT_TRUE(bus) << bus.error().text();
    return *std::move(bus);
  };
  const auto manager = open("manager", Side::kManager);
  const auto host = open("host", Side::kAll);
  const auto other = open("other", Side::kAll);
  const auto monitor = open("monitor", Side::kMonitor);
  AllEnds ends[] = {AllEnds::on(*manager), AllEnds::on(*host), AllEnds::on(*other),
                    AllEnds::on(*monitor)};
  std::map<std::string, std::set<std::string>> known;
  const auto all = [](std::initializer_list<const char*> names) {
    std::set<std::string> matches;
    for (const char* const name : names) {
      for (const char* const topic : {"rave/run", "rave/host_state", "rave/last_obstacle"}) {
        matches.insert(fmt::format("{} reads {}", name, topic));
        matches.insert(fmt::format("{} writes {}", name, topic));
      }
    }
    return matches;
  };
  EXPECT_TRUE(eventually([&] {
    return matches_of(*manager, known, "manager") == all({"host", "other"}) &&
           matches_of(*monitor, known, "monitor") == all({"host", "other"}) &&
           matches_of(*host, known, "host") == all({"manager", "other", "monitor"}) &&
           matches_of(*other, known, "other") == all({"manager", "host", "monitor"});
  }));
  // Nothing comes of it later, either: what is written reaches hosts alone.
  RunState state{};
  state.step_s = 0.01;
  state.step = 7;
  ASSERT_TRUE(ends[0].runs.write(state));
  std::size_t heard = 0;
  EXPECT_TRUE(eventually([&] {
    heard += ends[1].runs_in.take([](const RunState&) {});
    return heard == 1;
  }));
  EXPECT_EQ(ends[3].runs_in.take([](const RunState&) {}), 0U);
  EXPECT_EQ(matches_of(*manager, known, "manager"), all({"host", "other"}));
  EXPECT_EQ(matches_of(*monitor, known, "monitor"), all({"host", "other"}));
}

/// Two runs in one domain, and processes that look at both.
class AllRuns : public ::testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<Bus> open(const char* name, const RunId& run, Side side) const {
    BusConfig config = domain_.config();
    config.participant = name;
    config.run = run;
    config.side = side;
    config.beside = true;
    config.anonymous = config.all_runs = run.none();
    auto bus = Bus::open(config);
    EXPECT_TRUE(bus) << bus.error().text();
    return *std::move(bus);
  }

  TestDomain domain_;
  RunId one_ = RunId::random();
  RunId two_ = RunId::random();
  std::unique_ptr<Bus> first_ = open("first", one_, Side::kAll);
  std::unique_ptr<Bus> second_ = open("second", two_, Side::kAll);
  std::unique_ptr<Bus> asker_ = open("asker", RunId(), Side::kAll);
};

TEST_F(AllRuns, AreHeardByWhoLooksAtThemAndTheirManagersNotByMonitors) {
  const auto manager = open("manager", one_, Side::kManager);
  const auto monitor = open("monitor", RunId(), Side::kMonitor);
  std::vector<Writer<HostInfo>> infos;
  for (Bus* const bus : {manager.get(), first_.get(), second_.get()}) {
    infos.push_back(*Writer<HostInfo>::create(*bus));
    HostInfo info{};
    put_text(info.name, bus->config().participant);
    put_text(info.version, "1");
    ASSERT_TRUE(infos.back().write(info));
  }
  // By name: the run.
  std::map<std::string, std::string> seen;
  const auto see = [&seen](Reader<HostInfo>& reader) {
    reader.take([&seen](const HostInfo& info) {
      RunId run;
      std::ranges::copy(info.run, run.bytes.begin());
      seen[info.name] = run.text();
    });
    return seen.size();
  };
  auto all = *Reader<HostInfo>::create(*asker_);
  EXPECT_TRUE(eventually([&] { return see(all) == 3; }));
  EXPECT_EQ(seen["second"], two_.text());
  seen.clear();
  auto hosts = *Reader<HostInfo>::create(*monitor);
  EXPECT_TRUE(eventually([&] { return see(hosts) == 2; }));
  EXPECT_EQ(seen["first"], one_.text());
  EXPECT_FALSE(seen.contains("manager"));
}

TEST_F(AllRuns, ARequestReachesTheRunThatItNames) {
  auto requests = *Writer<Request>::create(*asker_);
  auto asked_first = *Reader<Request>::create(*first_);
  auto asked_second = *Reader<Request>::create(*second_);
  EXPECT_TRUE(eventually([&] { return requests.readers() == 2; }));
  Request request{};
  std::ranges::copy(two_.bytes, request.run);
  request.target = second_->writer();
  request.number = 1;
  put_text(request.from, "asker");
  borrow_text(request.text, "stop");
  ASSERT_TRUE(requests.write(request));
  std::size_t heard = 0;
  EXPECT_TRUE(eventually([&] {
    heard += asked_second.take([](const Request&) {});
    return heard == 1;
  }));
  EXPECT_EQ(asked_first.take([](const Request&) {}), 0U);
}

}  // namespace
}  // namespace rave::bus::testing
