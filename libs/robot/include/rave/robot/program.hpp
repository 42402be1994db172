// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/robot/interface.hpp"
#include "rave/robot/percepts.hpp"
#include "rave/robot/setup.hpp"

namespace rave {

/// The one class that the author of a robot program writes. One object per robot; start() comes
/// once before the first decide(); all calls of one object come from one thread at a time. A
/// program sees readings and gives commands; nothing tells it what is real and what is virtual.
///
/// A program that takes orders of people says which, by a public constant of its class:
/// `static constexpr OrderSet kTakes = kTakesGoal | kTakesText;`. See Percepts::orders().
class DecisionProcess {
 public:
  virtual ~DecisionProcess() = default;
  /// Looks up sensors and controllers. An error keeps the run from starting.
  virtual Status start(const Setup& setup) = 0;
  virtual void decide(const Percepts& percepts, Commands& commands) = 0;
  /// Somebody changed parameters while the robot runs; comes between two decisions, with all of
  /// them. An error refuses the change: the program goes on with the old ones.
  virtual Status parameters_changed(const Params& /*params*/) {
    return fail(ErrorCode::kInvalidArgument, "it takes no new parameters while it runs");
  }
};

/// The function table of a program.
struct ProgramOps {
  InstanceOps instance;
  int (*start)(void* instance, const ProgramSetup* setup, ErrorText* error) = nullptr;
  /// Decides for `count` robots whose instances lie side by side, `stride` bytes apart. Sets
  /// `failed[i]` to 1 and `error` for instances that threw, and goes on with the others.
  void (*decide)(void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                 std::uint8_t* failed, ErrorText* error) = nullptr;
  UpdateFunction update = nullptr;
  OrderSet takes = 0;  ///< Orders that go to the program.
  std::uint32_t reserved = 0;
};

namespace detail {
template <class Program>
constexpr OrderSet taken_orders() noexcept {
  if constexpr (requires { Program::kTakes; }) {
    static_assert((Program::kTakes & ~(kTakesGoal | kTakesPath | kTakesText)) == 0,
                  "a program takes goals, paths and texts");
    return Program::kTakes;
  }
  return 0;
}

template <class Program>
constexpr ProgramOps program_ops() noexcept {
  ProgramOps ops;
  ops.instance = instance_ops<Program>();
  ops.start = [](void* instance, const ProgramSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<Program*>(instance)->start(Setup(*setup)); });
  };
  ops.update = update_function<Program>();
  ops.takes = taken_orders<Program>();
  ops.decide = [](void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                  std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      if (failed[i] != 0) continue;
      const int status = guarded(error, [&]() -> Status {
        Commands commands(items[i]);
        instance_at<Program>(first, stride, i).Program::decide(Percepts(items[i]), commands);
        return {};
      });
      if (status != 0) {
        failed[i] = 1;
        error->slot = static_cast<std::uint32_t>(i);
      }
    }
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
