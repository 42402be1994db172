// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "rave/live_testing/scratch.hpp"

namespace rave::testing {

/// `rave run`, or another command with the same options, as a process.
class RaveRun {
 public:
  RaveRun(const std::string& scenario, const std::string& output,
          const std::vector<std::string>& more = {"--no-picture"}, const char* command = "run") {
    std::string path = RAVE_BINARY_DIR "/bin/rave";
    std::vector<std::string> texts{path, command, scenario, "--output", output, "--quiet"};
    texts.insert(texts.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    EXPECT_EQ(::posix_spawn(&pid_, path.c_str(), nullptr, nullptr, arguments.data(), environ), 0);
  }
  RaveRun(const RaveRun&) = delete;
  RaveRun& operator=(const RaveRun&) = delete;
  ~RaveRun() {
    if (pid_ > 0) kill();
  }

  /// Waits for the end; returns the exit code.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Kills the process (SIGKILL).
  void kill() {
    ::kill(pid_, SIGKILL);
    (void)wait();
  }
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Ends it with SIGINT, like Ctrl-C.
  void interrupt() const { ::kill(pid_, SIGINT); }

 private:
  pid_t pid_ = -1;
};

/// A peer, a scenario that uses it, and a folder for their files.
class ScenarioRun {
 public:
  explicit ScenarioRun(const std::string& prefix) : scratch_(prefix) {}
  ScenarioRun(const ScenarioRun&) = delete;
  ScenarioRun& operator=(const ScenarioRun&) = delete;
  ~ScenarioRun() {
    rave.reset();
    peer.reset();
  }

  void start() { rave = std::make_unique<RaveRun>(file("scenario.yaml"), file("out")); }
  [[nodiscard]] nlohmann::json result() const {
    std::ifstream stream(file("out/result.json"));
    return nlohmann::json::parse(stream, nullptr, false);
  }
  [[nodiscard]] nlohmann::json state() { return state_of(*peer); }
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    return await_answer([this] { return state(); }, wanted);
  }
  /// Waits until the console log contains `text` at least `times` times.
  void await_console(const std::string& text, int times) const {
    const nlohmann::json counted =
        await_answer([&] { return nlohmann::json(said(text)); },
                     [&](const nlohmann::json& count) { return count.get<int>() >= times; });
    EXPECT_GE(counted.get<int>(), times) << text;
  }
  /// How many times the console log contains `text`.
  [[nodiscard]] int said(const std::string& text) const {
    std::ifstream stream(file("out/console.log"));
    const std::string log{std::istreambuf_iterator<char>(stream), {}};
    int times = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++times;
    return times;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return scratch_.file(name); }
  /// Writes a file. A scenario without `max_missed_pct` gets 100: these tests are not about
  /// deadlines, which a loaded test machine misses.
  void write(const std::string& name, const std::string& text) const {
    const bool silent = text.find("max_missed_pct:") == std::string::npos;
    scratch_.write(name, name == "scenario.yaml" && silent ? text + "max_missed_pct: 100\n" : text);
  }

  std::unique_ptr<PeerProcess> peer;
  std::unique_ptr<RaveRun> rave;

 private:
  Scratch scratch_;
};

}  // namespace rave::testing
