// SPDX-License-Identifier: Apache-2.0
#include "rave/bus_testing/peer_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>

extern char** environ;

namespace rave::bus::testing {

TestDomain::TestDomain() {
  std::random_device chance;
  // Higher ones use ports that the kernel gives to others.
  domain = 1 + chance() % 90;
  tag = "test-" + std::to_string(::getpid()) + "-" + std::to_string(chance());
}

BusConfig TestDomain::config(const std::string& participant) const {
  BusConfig config;
  config.participant = participant;
  config.domain = domain;
  config.tag = tag;
  config.run = run;
  return config;
}

PeerProcess::PeerProcess(const TestDomain& domain, const std::string& role, const std::string& name,
                         const std::vector<std::string>& arguments, const std::string& program) {
  std::vector<std::string> words = {std::string(RAVE_BINARY_DIR) + "/tests/peers/" + program,
                                    role,
                                    "name=" + name,
                                    "domain=" + std::to_string(domain.domain),
                                    "tag=" + domain.tag,
                                    "run=" + domain.run.text()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int input[2];
  int output[2];
  if (::pipe2(input, O_CLOEXEC) != 0 || ::pipe2(output, O_CLOEXEC) != 0) return;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  if (::posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ) != 0) {
    process_ = -1;
  }
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(input[0]);
  ::close(output[1]);
  input_ = input[1];
  output_ = output[0];
}

std::string PeerProcess::line() {
  std::string line;
  char byte = 0;
  while (true) {
    pollfd output{output_, POLLIN, 0};
    if (::poll(&output, 1, kPatience_s * 1000) <= 0) return "";
    if (::read(output_, &byte, 1) <= 0) return "";
    if (byte == '\n') return line;
    line += byte;
  }
}

void PeerProcess::poke() const { static_cast<void>(!::write(input_, "x", 1)); }

void PeerProcess::pause() const {
  ::kill(process_, SIGSTOP);
  // All its threads stand when this returns.
  ::waitpid(process_, nullptr, WUNTRACED);
}

void PeerProcess::resume() const { ::kill(process_, SIGCONT); }

int PeerProcess::end() {
  ::close(std::exchange(input_, -1));
  int status = 0;
  ::waitpid(std::exchange(process_, -1), &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void PeerProcess::kill() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(std::exchange(process_, -1), nullptr, 0);
  }
  if (input_ >= 0) ::close(std::exchange(input_, -1));
  if (output_ >= 0) ::close(std::exchange(output_, -1));
}

bool eventually(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kPatience_s);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    ::poll(nullptr, 0, 5);
  }
  return true;
}

BusEvent await_event(Bus& bus, EventKind kind) {
  BusEvent found;
  const bool came = eventually([&] {
    for (BusEvent& event : bus.take_events()) {
      if (event.kind != kind) continue;
      found = std::move(event);
      return true;
    }
    return false;
  });
  if (!came) found.text = "no such event";
  return found;
}

}  // namespace rave::bus::testing
