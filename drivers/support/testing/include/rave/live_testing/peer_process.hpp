// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

#include "rave/live_testing/await.hpp"

extern char** environ;

namespace rave::testing {

/// A simulated peer (tests/peers) as a process: it reads commands from its input and writes lines
/// to its output. The destructor ends it.
class PeerProcess {
 public:
  PeerProcess(const std::string& program, std::vector<std::string> options) {
    int input[2];
    int output[2];
    EXPECT_EQ(::pipe2(input, O_CLOEXEC), 0);
    EXPECT_EQ(::pipe2(output, O_CLOEXEC), 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input[0], 0);
    posix_spawn_file_actions_adddup2(&actions, output[1], 1);
    std::string path = RAVE_BINARY_DIR "/tests/peers/" + program;
    std::vector<char*> arguments{path.data()};
    for (std::string& option : options) arguments.push_back(option.data());
    arguments.push_back(nullptr);
    EXPECT_EQ(::posix_spawn(&pid_, path.c_str(), &actions, nullptr, arguments.data(), environ), 0)
        << path;
    posix_spawn_file_actions_destroy(&actions);
    ::close(input[0]);
    ::close(output[1]);
    to_ = input[1];
    from_ = output[0];
    ready_ = wait_for("ready");
  }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;
  ~PeerProcess() {
    ::close(to_);
    ::close(from_);
    if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
  }

  /// The text that the peer wrote after `ready `.
  [[nodiscard]] const std::string& where() const { return ready_; }
  /// Sends a command and waits for its confirmation.
  void tell(const std::string& command) {
    const std::string line = command + "\n";
    EXPECT_EQ(::write(to_, line.data(), line.size()), static_cast<ssize_t>(line.size()));
    (void)wait_for("ok " + command.substr(0, command.find(' ')));
  }
  /// Sends a command whose answer is a line that begins with the command; returns the rest of that
  /// line.
  std::string ask(const std::string& command) {
    const std::string line = command + "\n";
    EXPECT_EQ(::write(to_, line.data(), line.size()), static_cast<ssize_t>(line.size()));
    std::string answer = wait_for(command);
    (void)wait_for("ok " + command);
    return answer;
  }
  /// Waits for a line that begins with `beginning`; returns the rest of it.
  std::string wait_for(const std::string& beginning) {
    while (true) {
      for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
        const std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        if (line.rfind(beginning, 0) != 0) continue;
        return line.size() > beginning.size() ? line.substr(beginning.size() + 1) : "";
      }
      pollfd wanted{from_, POLLIN, 0};
      char room[256];
      const int ready =
          ::poll(&wanted, 1, static_cast<int>(std::chrono::milliseconds(kLong).count()));
      const ssize_t size = ready > 0 ? ::read(from_, room, sizeof room) : 0;
      if (size <= 0) {
        ADD_FAILURE() << "the peer does not say `" << beginning << "`";
        return "";
      }
      text_.append(room, static_cast<std::size_t>(size));
    }
  }

 private:
  pid_t pid_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string text_;
  std::string ready_;
};

}  // namespace rave::testing
