// SPDX-License-Identifier: Apache-2.0
// Programs that go wrong. The tests find the lines by their marks.

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rave/robot/plugin_entry.hpp"

// These faults are the purpose, so sanitizers must not report them in our place.
#define RAVE_WANTED_FAULT __attribute__((no_sanitize("undefined", "address")))

namespace {

using rave::Commands;
using rave::Percepts;
using rave::Setup;
using rave::Status;

struct Fault : rave::DecisionProcess {
  Status start(const Setup& setup) override {
    own_setup = setup;
    return {};
  }
  void decide(const Percepts&, Commands&) override {}

  std::optional<Setup> own_setup;
};

struct NullPointer final : Fault {
  RAVE_WANTED_FAULT void decide(const Percepts&, Commands&) override {
    *target = 1;  // mark: null_pointer
  }
  int* volatile target = nullptr;
};

struct NullCall final : Fault {
  RAVE_WANTED_FAULT void decide(const Percepts&, Commands&) override {
    target();  // mark: null_call
    ++calls;
  }
  void (*volatile target)() = nullptr;
  int calls = 0;
};

struct Division final : Fault {
  RAVE_WANTED_FAULT void decide(const Percepts&, Commands&) override {
    divisor = 100 / divisor;  // mark: division
  }
  volatile int divisor = 0;
};

struct StackOverflow final : Fault {
  RAVE_WANTED_FAULT void decide(const Percepts&, Commands&) override { depth = recurse(1); }
  RAVE_WANTED_FAULT __attribute__((noinline)) int recurse(int level) {
    volatile char room[512] = {};  // mark: stack_overflow
    room[level % 512] = 1;
    return level == enough ? 0 : recurse(level + 1) + room[0];  // mark: stack_overflow_end
  }
  int depth = 0;
  volatile int enough = 0;
};

struct Abort final : Fault {
  void decide(const Percepts&, Commands&) override {
    std::abort();  // mark: abort
  }
};

/// The fault is inside the standard library; the line that matters is the caller's.
struct BadVector final : Fault {
  RAVE_WANTED_FAULT void decide(const Percepts&, Commands&) override {
    std::string text(*size, 'x');  // mark: bad_vector
    own_setup->log(text);
  }
  std::size_t* volatile size = nullptr;
};

struct Throws final : Fault {
  void decide(const Percepts&, Commands&) override { throw std::runtime_error("no map"); }
};

struct Endless final : Fault {
  void decide(const Percepts&, Commands&) override {
    while (!done) {  // mark: endless
    }
  }
  volatile bool done = false;
};

struct Sleeps final : Fault {
  void decide(const Percepts&, Commands&) override {
    while (::pause() != 0) {  // mark: sleeps
    }
  }
};

struct Exits final : Fault {
  void decide(const Percepts&, Commands&) override { std::exit(3); }
};

struct Killed final : Fault {
  void decide(const Percepts&, Commands&) override { ::kill(::getpid(), 9); }
};

struct ClosesFiles final : Fault {
  void decide(const Percepts&, Commands&) override {
    for (int file = 3; file < 64; ++file) ::close(file);
    for (;;) ::pause();
  }
};

struct Garbage final : Fault {
  void decide(const Percepts&, Commands&) override {
    for (int file = 3; file < 64; ++file) {
      if (::write(file, "what is this?", 13) == 13) break;
    }
    for (;;) ::pause();
  }
};

struct StartError final : Fault {
  Status start(const Setup& setup) override {
    return setup.sensor<float>("lidar") ? Status{} : rave::fail(rave::ErrorCode::kNotFound, "none");
  }
};

struct StartHangs final : Fault {
  Status start(const Setup&) override {
    while (!done) {  // mark: start_hangs
    }
    return {};
  }
  volatile bool done = false;
};

struct StartCrashes final : Fault {
  RAVE_WANTED_FAULT Status start(const Setup&) override {
    *target = 1;  // mark: start_crashes
    return {};
  }
  int* volatile target = nullptr;
};

struct Talks final : Fault {
  void decide(const Percepts&, Commands&) override {
    for (int i = 0; i < 100; ++i) own_setup->log("line " + std::to_string(i));
  }
};

struct LastWords final : Fault {
  void decide(const Percepts&, Commands&) override {
    own_setup->log("this will not end well");
    std::abort();
  }
};

}  // namespace

RAVE_PLUGIN(
    "null_pointer null_call division stack_overflow abort bad_vector throws endless sleeps "
    "exits killed closes_files garbage start_error start_hangs start_crashes talks last_words") {
  rave::add_program<NullPointer>(registry, {.name = "null_pointer", .summary = "Goes wrong."});
  rave::add_program<NullCall>(registry, {.name = "null_call", .summary = "Goes wrong."});
  rave::add_program<Division>(registry, {.name = "division", .summary = "Goes wrong."});
  rave::add_program<StackOverflow>(registry, {.name = "stack_overflow", .summary = "Goes wrong."});
  rave::add_program<Abort>(registry, {.name = "abort", .summary = "Goes wrong."});
  rave::add_program<BadVector>(registry, {.name = "bad_vector", .summary = "Goes wrong."});
  rave::add_program<Throws>(registry, {.name = "throws", .summary = "Goes wrong."});
  rave::add_program<Endless>(registry, {.name = "endless", .summary = "Goes wrong."});
  rave::add_program<Sleeps>(registry, {.name = "sleeps", .summary = "Goes wrong."});
  rave::add_program<Exits>(registry, {.name = "exits", .summary = "Goes wrong."});
  rave::add_program<Killed>(registry, {.name = "killed", .summary = "Goes wrong."});
  rave::add_program<ClosesFiles>(registry, {.name = "closes_files", .summary = "Goes wrong."});
  rave::add_program<Garbage>(registry, {.name = "garbage", .summary = "Goes wrong."});
  rave::add_program<StartError>(registry, {.name = "start_error", .summary = "Goes wrong."});
  rave::add_program<StartHangs>(registry, {.name = "start_hangs", .summary = "Goes wrong."});
  rave::add_program<StartCrashes>(registry, {.name = "start_crashes", .summary = "Goes wrong."});
  rave::add_program<Talks>(registry, {.name = "talks", .summary = "Goes wrong."});
  rave::add_program<LastWords>(registry, {.name = "last_words", .summary = "Goes wrong."});
}
