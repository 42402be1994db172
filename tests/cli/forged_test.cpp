// SPDX-License-Identifier: Apache-2.0
// Reports that no host has sent: a run is never left hanging by them.
#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include "onlooker.hpp"
#include "rave/bus/sequence.hpp"
#include "shared_world.hpp"
#include "wrong_host.hpp"

namespace rave::cli_test {
namespace {

/// Speaks in the name of a host that is there.
class Forger {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Forger>> open(const bus::RunId& run,
                                                            const std::vector<std::string>& apart) {
    RAVE_TRY_ASSIGN(auto bus, join_as_onlooker(run, apart));
    RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
    RAVE_TRY_ASSIGN(auto reports, bus::Writer<bus::HostReport>::create(*bus));
    return std::unique_ptr<Forger>(
        new Forger(run, std::move(bus), std::move(infos), std::move(reports)));
  }
  /// Whether it has heard of the host, and the manager hears it.
  [[nodiscard]] bool knows(std::uint32_t host) {
    infos_.take([&](const bus::HostInfo& info) {
      if (info.host == host) name_ = info.writer;
    });
    return name_ != 0 && reports_.readers() > 0;
  }
  /// The bus would sign it with its own name.
  void say(std::uint32_t host, std::uint64_t step) {
    sim::HostReport report;
    report.host = host;
    report.step = step;
    bus::HostReport& sample = message_.fill(report, 0, 0);
    std::ranges::copy(run_.bytes, sample.run);
    sample.writer = name_;
    EXPECT_EQ(dds_write(reports_.handle(), &sample), DDS_RETCODE_OK);
  }

 private:
  Forger(const bus::RunId& run, std::unique_ptr<bus::Bus> bus, bus::Reader<bus::HostInfo> infos,
         bus::Writer<bus::HostReport> reports)
      : run_(run), bus_(std::move(bus)), infos_(std::move(infos)), reports_(std::move(reports)) {}

  bus::RunId run_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Reader<bus::HostInfo> infos_;
  bus::Writer<bus::HostReport> reports_;
  lock_step::ReportMessage message_;
  std::uint64_t name_ = 0;
};

class Forged : public SharedWorld {
 protected:
  bus::RunId run_ = bus::RunId::random();
  std::vector<std::string> words_ = {"--run", run_.text()};
};

TEST_F(Forged, ReportsInTheNameOfAHostChangeNothing) {
  const std::string alone = hash_alone("crowd.yaml", {});
  std::vector<std::string> words = words_;
  words.insert(words.end(), {"--pace", "1x"});
  start("env", "env", "crowd.yaml", words);
  start_host("one", "crowd.yaml", words);
  wait_for_line("env", "host `one` is here");
  auto forger = Forger::open(run_, apart());
  ASSERT_TRUE(forger) << forger.error().text();
  wait_until([&] { return (*forger)->knows(0); }, "the forger knows the host");
  const auto say_until = [&](const std::function<bool()>& done, const std::string& what) {
    std::uint64_t step = 1'000'000;
    wait_until(
        [&] {
          (*forger)->say(0, ++step);
          (*forger)->say(0, 1);
          return done();
        },
        what);
  };
  say_until(
      [&] {
        return console("env").find("another process sent it in the name of this process") !=
               std::string::npos;
      },
      "it is refused");
  start_host("two", "crowd.yaml", words);
  say_until([&] { return console("env").find("host `two` is here") != std::string::npos; },
            "the run begins");
  forger->reset();
  for (const char* const who : {"env", "one", "two"}) EXPECT_EQ(end_of(who), 0) << console(who);
  EXPECT_EQ(result("env")["hash"], alone);
}

/// Whoever can forge what DDS says of a sender is not told from the host itself.
TEST_F(Forged, AReportOfAStepThatCannotBeEndsTheRunWithAMessage) {
  start("env", "env", "crowd.yaml", words_);
  auto wrong = WrongHost::open(run_, apart(), 1);
  ASSERT_TRUE(wrong) << wrong.error().text();
  wait_until([&] { return (*wrong)->introduce(); }, "the manager is there");
  start_host("one", "crowd.yaml", words_);
  sim::HostReport report;
  report.host = 1;
  wait_until(
      [&] {
        EXPECT_TRUE((*wrong)->say(report));
        return console("env").find("host `two` is here") != std::string::npos;
      },
      "it has its slot");
  wait_for_line("one", "waiting for two");
  report.step = 1'000'000;
  wait_until(
      [&] {
        EXPECT_TRUE((*wrong)->say(report));
        return !runs("env");
      },
      "the manager ends");
  EXPECT_NE(end_of("env"), 0);
  const std::string why = "it is of step 1000000, but step ";
  EXPECT_EQ(end_of("one"), 1) << console("one");
  const std::string told = result("one")["ending"].dump();
  EXPECT_NE(told.find(why), std::string::npos) << told;
}

TEST_F(Forged, AStepThatAHostDoesNotSayAnyMoreIsNotWaitedFor) {
  start("env", "env", "crowd.yaml", words_);
  auto wrong = WrongHost::open(run_, apart(), 1);
  ASSERT_TRUE(wrong) << wrong.error().text();
  wait_until([&] { return (*wrong)->introduce(); }, "the manager is there");
  sim::HostReport report;
  report.host = 1;
  report.step = 1'000'000;
  // As of one that still has a manager: a forgotten one would be left alone.
  constexpr std::uint64_t kOther = 7;
  wait_until(
      [&] {
        EXPECT_TRUE((*wrong)->say(report, kOther));
        return console("env").find("host `two` is here") != std::string::npos;
      },
      "it has its slot");
  report.step = 0;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE((*wrong)->say(report));
  start_host("one", "crowd.yaml", words_);
  wait_for_line("one", "waiting for two");
  wrong->reset();
  // Not before the run began.
  wait_for_line("env", "host `two` is gone in step ");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1) << console("env");
}

}  // namespace
}  // namespace rave::cli_test
