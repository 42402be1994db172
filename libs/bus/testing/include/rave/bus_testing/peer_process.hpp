// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/bus/bus.hpp"

namespace rave::bus::testing {

/// No test waits longer for what must come.
inline constexpr int kPatience_s = 60;

/// A corner of the machine's loopback where only one test is: a random domain and tag.
struct TestDomain {
  std::uint32_t domain = 0;
  std::string tag;
  RunId run = RunId::random();

  TestDomain();
  [[nodiscard]] BusConfig config(const std::string& participant = "test") const;
};

/// The program peer_bus, or another of its kind, in a process of its own, killed at the end.
class PeerProcess {
 public:
  PeerProcess(const TestDomain& domain, const std::string& role, const std::string& name,
              const std::vector<std::string>& arguments = {},
              const std::string& program = "peer_bus");
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;
  ~PeerProcess() { kill(); }

  /// The next line that it says; empty if none comes.
  [[nodiscard]] std::string line();
  /// Gives it a byte to read.
  void poke() const;
  /// It does nothing any more, and is not gone, until it resumes.
  void pause() const;
  void resume() const;
  /// Lets it end in order, and waits for that; its exit code.
  int end();
  void kill();

 private:
  pid_t process_ = -1;
  int input_ = -1;
  int output_ = -1;
};

/// Calls `done` until it is true, with 5 ms between; false if it does not become so.
[[nodiscard]] bool eventually(const std::function<bool()>& done);

/// The next event of that kind; others are dropped.
[[nodiscard]] BusEvent await_event(Bus& bus, EventKind kind);

}  // namespace rave::bus::testing
