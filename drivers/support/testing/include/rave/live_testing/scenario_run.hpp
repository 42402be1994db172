// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "rave/live_testing/scratch.hpp"

namespace rave::testing {

/// `rave run` as a process, or another command with the same options.
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

  /// The exit code.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// As a crash or the kernel does it: nothing of the process runs any more.
  void kill() {
    ::kill(pid_, SIGKILL);
    (void)wait();
  }
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Ends it as a user does.
  void interrupt() const { ::kill(pid_, SIGINT); }

 private:
  pid_t pid_ = -1;
};

/// A peer, a scenario that it takes part in, and a folder for their files.
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
  /// Until the console has said something so many times.
  void await_console(const std::string& text, int times) const {
    const nlohmann::json counted =
        await_answer([&] { return nlohmann::json(said(text)); },
                     [&](const nlohmann::json& count) { return count.get<int>() >= times; });
    EXPECT_GE(counted.get<int>(), times) << text;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return scratch_.file(name); }
  /// A scenario that does not say how late it may be may be as late as it likes: a machine that
  /// runs tests has no time to spare, and that is not what they are about.
  void write(const std::string& name, const std::string& text) const {
    const bool silent = text.find("max_missed_pct:") == std::string::npos;
    scratch_.write(name, name == "scenario.yaml" && silent ? text + "max_missed_pct: 100\n" : text);
  }

  std::unique_ptr<PeerProcess> peer;
  std::unique_ptr<RaveRun> rave;

 private:
  [[nodiscard]] int said(const std::string& text) const {
    std::ifstream stream(file("out/console.log"));
    const std::string log{std::istreambuf_iterator<char>(stream), {}};
    int times = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++times;
    return times;
  }

  Scratch scratch_;
};

}  // namespace rave::testing
