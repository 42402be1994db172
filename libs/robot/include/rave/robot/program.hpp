// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/robot/interface.hpp"
#include "rave/robot/map_view.hpp"
#include "rave/robot/percepts.hpp"
#include "rave/robot/setup.hpp"

namespace rave {

/// The base class of a robot program, the one class that its author writes. One object per robot.
/// start() is called once, before the first decide(); calls of one object never overlap. A program
/// receives readings and gives commands; nothing tells it what is real and what is virtual.
///
/// A program that takes orders of users lists their kinds in a public constant: `static constexpr
/// OrderSet kTakes = kTakesGoal | kTakesText;`. See Percepts::orders(). One that keeps a map has
/// a public function `MapView map() const`; viewers and the Map Server then get that map.
class DecisionProcess {
 public:
  virtual ~DecisionProcess() = default;
  /// Looks up sensors and controllers. An error prevents the start of the run.
  virtual Status start(const Setup& setup) = 0;
  virtual void decide(const Percepts& percepts, Commands& commands) = 0;
  /// New parameter values while the robot runs, called between two decisions with all parameters.
  /// An error refuses the change; the old values remain.
  virtual Status parameters_changed(const Params& /*params*/) {
    return fail(ErrorCode::kInvalidArgument, kTakesNoParameters);
  }
};

/// The function table of a program.
struct ProgramOps {
  InstanceOps instance;
  int (*start)(void* instance, const ProgramSetup* setup, ErrorText* error) = nullptr;
  /// Decides for `count` robots whose instances are `stride` bytes apart. For instances that throw,
  /// sets `failed[i]` to 1 and `error`, and continues with the others.
  void (*decide)(void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                 std::uint8_t* failed, ErrorText* error) = nullptr;
  UpdateFunction update = nullptr;
  /// The map of an instance, between two decisions; null: programs of this kind keep none.
  void (*map)(const void* instance, MapView* view) = nullptr;
  OrderSet takes = 0;  ///< Kinds of orders that are passed to the program.
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
  if constexpr (requires(const Program& program) { program.map(); }) {
    ops.map = [](const void* instance, MapView* view) {
      ErrorText ignored;
      guarded(&ignored, [&] { *view = static_cast<const Program*>(instance)->map(); });
    };
  }
  ops.decide = [](void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                  std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      if (failed[i] != 0) continue;
      guarded_slot(i, failed, error, [&] {
        Commands commands(items[i]);
        instance_at<Program>(first, stride, i).Program::decide(Percepts(items[i]), commands);
      });
    }
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
