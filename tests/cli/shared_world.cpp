// SPDX-License-Identifier: Apache-2.0
#include "shared_world.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <random>
#include <thread>

namespace rave::cli_test {

SharedWorld::SharedWorld() {
  std::random_device chance;
  tag_ = "test-" + std::to_string(::getpid()) + "-" + std::to_string(chance());
  // Higher ones use ports that the kernel gives to others.
  domain_ = static_cast<int>(1 + chance() % 90);
}

SharedWorld::~SharedWorld() {
  for (auto& [name, process] : processes_) {
    if (process <= 0) continue;
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
}

std::vector<std::string> SharedWorld::apart() const {
  return {"--bus-tag", tag_, "--domain", std::to_string(domain_)};
}

std::string SharedWorld::folder(const std::string& name) const {
  return (folder_.path() / name).string();
}

void SharedWorld::start(const std::string& name, const std::string& what,
                        const std::string& scenario, std::vector<std::string> more) {
  std::vector<std::string> words = {what, scenario};
  words.insert(words.end(), more.begin(), more.end());
  start_in(folder_.path(), name, std::move(words));
}

void SharedWorld::start_in(const std::string& runtime, const std::string& name,
                           std::vector<std::string> words) {
  for (const std::string& word : apart()) words.push_back(word);
  start_words(runtime, name, std::move(words));
}

void SharedWorld::start_as_told(const std::string& name, std::vector<std::string> words) {
  start_words(folder_.path(), name, std::move(words));
}

void SharedWorld::start_words(const std::string& runtime, const std::string& name,
                              std::vector<std::string> words) {
  // The folder of a run is refused to another one.
  std::filesystem::remove_all(folder(name));
  words.insert(words.end(), {"--output", folder(name)});
  const pid_t process = start_rave(
      words, {"XDG_RUNTIME_DIR=" + runtime, std::string("TMPDIR=") + folder_.path().string()});
  ASSERT_GT(process, 0);
  processes_[name] = process;
}

void SharedWorld::start_elsewhere(const std::string& host, const std::string& scenario) {
  start_in(elsewhere_.path(), host, {"robot", scenario, "--host", host, "--no-record"});
}

void SharedWorld::start_host(const std::string& host, const std::string& scenario,
                             std::vector<std::string> more) {
  more.insert(more.begin(), {"--host", host});
  start(host, "robot", scenario, std::move(more));
}

std::string SharedWorld::crowd_with_policy(const std::string& policy, double timeout_s) const {
  std::string text = content_of(RAVE_SOURCE_DIR "/tests/cli/data/crowd.yaml");
  const std::string robot = "file: ";
  for (std::size_t at = 0; (at = text.find(robot, at)) != std::string::npos;) {
    at += robot.size();
    text.insert(at, RAVE_SOURCE_DIR "/tests/cli/data/");
  }
  const auto path = folder_.path() / "policy.yaml";
  std::ofstream(path) << text << "on_lost_host: " << policy << "\nhost_timeout_s: " << timeout_s
                      << "\n";
  return path;
}

int SharedWorld::end_of(const std::string& name) {
  return wait_for(std::exchange(processes_.at(name), -1));
}

void SharedWorld::signal(const std::string& name, int number) {
  ASSERT_EQ(::kill(processes_.at(name), number), 0);
}

bool SharedWorld::runs(const std::string& name) {
  // Whoever waits for its end later still gets it.
  siginfo_t ended{};
  const auto process = static_cast<id_t>(processes_.at(name));
  return ::waitid(P_PID, process, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0;
}

void SharedWorld::end_by_hand(const std::string& manager, int code) {
  signal(manager, SIGINT);
  EXPECT_EQ(end_of(manager), code) << console(manager);
}

nlohmann::json SharedWorld::result(const std::string& name) const {
  return nlohmann::json::parse(content_of(folder(name) + "/result.json"), nullptr, false);
}

std::string SharedWorld::console(const std::string& name) const {
  return content_of(folder(name) + "/console.log");
}

void SharedWorld::wait_until(const std::function<bool()>& holds, const std::string& what) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < end) {
    if (holds()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  FAIL() << "never: " << what;
}

void SharedWorld::wait_for_line(const std::string& name, const std::string& text) {
  wait_until([&] { return console(name).find(text) != std::string::npos; }, name + ": " + text);
  if (HasFailure()) std::cerr << console(name);
}

std::string hash_alone(const std::string& scenario, const std::vector<std::string>& more) {
  const TemporaryFolder folder;
  std::vector<std::string> words = {
      "run", scenario, "--output", folder.path() / "alone", "--processes",
      "1",   "--pace", "max",      "--no-record",           "--no-picture"};
  words.insert(words.end(), more.begin(), more.end());
  static_cast<void>(run_rave(words));
  const auto result =
      nlohmann::json::parse(content_of(folder.path() / "alone/result.json"), nullptr, false);
  return result.is_object() && result["hash"].is_string() ? result["hash"].get<std::string>() : "";
}

}  // namespace rave::cli_test
