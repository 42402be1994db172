// SPDX-License-Identifier: Apache-2.0
// `rave top` beside real runs.
#include <csignal>
#include <sstream>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;

class Top : public SharedWorld {
 protected:
  [[nodiscard]] Words words(Words more) const {
    Words all = {"top"};
    all.insert(all.end(), more.begin(), more.end());
    for (const std::string& word : apart()) all.push_back(word);
    return all;
  }
  [[nodiscard]] Words variables() const { return {"XDG_RUNTIME_DIR=" + folder_.path().string()}; }
  [[nodiscard]] Ended look(Words more) const {
    return run_rave(words(std::move(more)), variables());
  }
  /// What one that goes on has said last.
  [[nodiscard]] Json last_of(const std::string& file) const {
    std::istringstream lines(content_of(folder(file)));
    std::string line;
    Json last = Json::object();
    while (std::getline(lines, line)) {
      Json json = Json::parse(line, nullptr, false);
      if (!json.is_discarded()) last = std::move(json);
    }
    return last;
  }
  void begin_live() {
    for (const char* const who : {"env", "one", "two"}) {
      Words more = {"--run", "watched"};
      if (who != std::string("env")) more.insert(more.end(), {"--host", who});
      start(who, who == std::string("env") ? "env" : "robot", "live.yaml", more);
    }
  }
  static Json host(const Json& document, const std::string& name) {
    for (const Json& host : document.value("hosts", Json::array())) {
      if (host["name"] == name) return host;
    }
    return {{"state", "not listed"}};
  }
  static Json robot(const Json& document, const std::string& name) {
    for (const Json& robot : document.value("robots", Json::array())) {
      if (robot["name"] == name) return robot;
    }
    return Json::object({{"host", "not listed"}});
  }
};

TEST_F(Top, SaysSoIfThereIsNoRunAndHowToStartOne) {
  const Ended ended = look({});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("no run is in progress: none on the bus in domain "), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("rave run flock --processes 3"), std::string::npos) << ended.err;
}

TEST_F(Top, HostsOfARunInRealTimeAndTheDeathOfOne) {
  begin_live();
  for (const char* const who : {"one", "two"}) {
    wait_for_line("env", std::string("host `") + who + "` is here");
  }
  const pid_t watcher = start_rave(words({"watched", "--json", "--robots", "--interval", "0.2"}),
                                   variables(), folder("watched"));
  ASSERT_GT(watcher, 0);
  wait_until(
      [this] {
        const Json seen = last_of("watched");
        return host(seen, "one")["state"] == "here" && host(seen, "one")["cores"].is_number() &&
               host(seen, "one")["asked_rate_hz"].is_number() &&
               host(seen, "one")["clock_bound_s"].is_number() &&
               host(seen, "one")["round_trip_s"].is_number() &&
               robot(seen, "left").value("age_s", Json()).is_number() &&
               robot(seen, "right")["host"] == "two";
      },
      "all is known of host `one`");
  const Json seen = last_of("watched");
  EXPECT_EQ(seen["scenario"], "live");
  EXPECT_EQ(seen["timing"], "real_time");
  EXPECT_EQ(seen["phase"], "running");
  EXPECT_EQ(host(seen, "environment manager")["state"], "here");
  const Json one = host(seen, "one");
  EXPECT_EQ(one["process"], id_of("one")) << one.dump();
  EXPECT_NEAR(one["asked_rate_hz"].get<double>(), 10, 1e-9) << one.dump();
  EXPECT_GT(one["memory_mb"], 1);
  EXPECT_EQ(seen["robots"].size(), 2U);
  EXPECT_EQ(robot(seen, "left")["host"], "one") << seen.dump();
  EXPECT_EQ(robot(seen, "left")["simulated"], true) << seen.dump();

  signal("one", SIGKILL);
  wait_until([this] { return host(last_of("watched"), "one")["state"] == "gone"; },
             "the killed host is shown as gone");
  EXPECT_EQ(host(last_of("watched"), "two")["state"], "here");
  ::kill(watcher, SIGINT);
  EXPECT_EQ(wait_for(watcher), 0);
  // Who looked on has left no trace.
  for (const char* const who : {"env", "two"}) {
    EXPECT_EQ(console(who).find("rave top"), std::string::npos) << console(who);
    EXPECT_EQ(console(who).find("another run"), std::string::npos) << console(who);
  }
}

TEST_F(Top, ATableOfARunInLockStep) {
  const std::string alone = hash_alone("crowd.yaml", {"--duration", "20"});
  for (const char* const who : {"env", "one", "two"}) {
    if (who == std::string("env")) {
      start("env", "env", "crowd.yaml", {"--pace", "2x", "--duration", "20"});
    } else {
      start_host(who, "crowd.yaml", {"--duration", "20"});
    }
  }
  wait_for_line("env", "host `two` is here");
  // By the name of its scenario, which is known only inside of the run.
  const Ended ended = look({"crowd", "--once", "--robots"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* const word :
       {"crowd   running", "in lock-step", "HOST", "manager", "one", "two", "here", "STEP",
        "RATE /s", "KIND", "left-1 ", "right-20", "simulated"}) {
    EXPECT_NE(ended.out.find(word), std::string::npos) << word << "\n" << ended.out;
  }
  EXPECT_EQ(ended.out.find('\x1b'), std::string::npos) << "no terminal, no colours";
  for (const char* const who : {"one", "two", "env"}) EXPECT_EQ(end_of(who), 0) << console(who);
  EXPECT_EQ(result("env")["hash"], alone) << "nobody noticed the onlooker";
}

TEST_F(Top, ARunOfOneProcess) {
  start("run", "run", "live.yaml", {"--processes", "1", "--no-picture"});
  Json seen;
  wait_until(
      [&] {
        const Ended ended = look({"--once", "--json", "--interval", "0.3"});
        if (ended.exit_code != 0) return false;
        seen = Json::parse(ended.out, nullptr, false);
        return seen["phase"] == "running" && seen["hosts"][0]["cores"].is_number();
      },
      "the run is seen");
  EXPECT_EQ(seen["timing"], "one_process");
  EXPECT_EQ(seen["scenario"], "live");
  EXPECT_EQ(seen["hosts"][0]["process"], id_of("run")) << seen.dump();
  EXPECT_EQ(seen["hosts"][0]["robots"], 2);
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 0);
}

TEST_F(Top, AWordThatIsNoRun) {
  begin_live();
  wait_for_line("env", "host `one` is here");
  const Ended ended = look({"wtached"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("there is no run `wtached`"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
