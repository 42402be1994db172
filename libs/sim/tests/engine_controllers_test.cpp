// SPDX-License-Identifier: Apache-2.0
// Robots with several controllers: which of them drives.
#include <array>

#include "obedient.hpp"
#include "rave/sim_testing/given.hpp"

namespace rave::sim::testing {
namespace {

/// Says to its two controllers, `slow` and `fast`, how fast to go; to which one, the tens of the
/// number of the decision say: to `fast` in the second ten and the fourth, else to `slow`.
class Torn final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(slow_, setup.controller(CommandKind::kVelocity, "slow"));
    RAVE_TRY_ASSIGN(fast_, setup.controller(CommandKind::kVelocity, "fast"));
    return {};
  }
  void decide(const Percepts&, Commands& commands) override {
    const bool fast = decision_++ / 10 % 2 == 1;
    commands.velocity(fast ? fast_ : slow_, 1, 0);
  }

 private:
  ControllerHandle slow_;
  ControllerHandle fast_;
  int decision_ = 0;
};

/// Gives a share of what it is told, and without being told a share of 1 m/s; throws in its call
/// `throw_at`, and after it.
class Share final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup& setup) override {
    share_ = given(setup.parameters(), "share");
    throw_at_ = static_cast<std::int64_t>(given(setup.parameters(), "throw_at"));
    return {};
  }
  Command control(const ControlInput& input) override {
    if (throw_at_ > 0 && ++calls_ >= throw_at_) throw std::runtime_error("burnt out");
    const bool told = input.command.kind != CommandKind::kNone;
    return velocity_command(share_ * (told ? input.command.value[0] : 1), 0);
  }

 private:
  double share_ = 0;
  std::int64_t throw_at_ = 0;
  std::int64_t calls_ = 0;
};

ControllerSpec share_of(const char* name, Numbers params, std::uint32_t actuator = 0) {
  static constexpr ControllerOps kShare = detail::controller_ops<Share>();
  ControllerSpec spec;
  spec.name = name;
  spec.driver = "share";
  spec.ops = &kShare;
  spec.params = numbers(params);
  spec.accepts = CommandKind::kVelocity;
  spec.actuator = actuator;
  return spec;
}

/// Both speak to the first actuator, or `fast` to another.
void give_two(RobotType& type, std::uint32_t fast_to = 0) {
  type.controllers.clear();
  type.controllers.push_back(share_of("slow", {{"share", 0.2}}));
  type.controllers.push_back(share_of("fast", {{"share", 0.5}}, fast_to));
}

double told_mps(const Engine& engine, RobotId robot, std::uint32_t actuator = 0) {
  return engine.actuator_command(robot, actuator).value[0];
}

TEST(EngineControllers, OfTwoTheOneSpeaksThatWasGivenACommandLast) {
  for (const bool slow_first : {true, false}) {
    EngineSpec spec;
    RobotType type = simulated_type();
    give_two(type);
    if (!slow_first) std::swap(type.controllers[0], type.controllers[1]);
    type.program = program<Torn>();
    const RobotId robot = add_robot(spec, std::move(type));
    const auto engine = make_engine(std::move(spec));
    for (int step = 0; step < 40; ++step) {
      run(*engine, 1);
      ASSERT_EQ(told_mps(*engine, robot), step / 10 % 2 == 1 ? 0.5 : 0.2) << step;
    }
    EXPECT_NEAR(engine->true_pose(robot).x, 0.01 * (20 * 0.5 + 20 * 0.2), 1e-9);
  }
}

TEST(EngineControllers, BeforeAnyCommandTheFirstOneSpeaks) {
  EngineSpec spec;
  RobotType type = simulated_type();
  give_two(type);
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(told_mps(*engine, robot), 0.2);
}

TEST(EngineControllers, EachActuatorHearsItsOwnAlone) {
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.actuators.push_back(std::move(obedient_type({}).actuators.front()));
  type.actuators.back().name = "arm";
  give_two(type, 1);
  type.program = program<Torn>();
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  // `fast` is told nothing for the first ten steps, in which the guard holds what it drives.
  run(*engine, 5);
  EXPECT_EQ(told_mps(*engine, robot, 0), 0.2);
  EXPECT_EQ(told_mps(*engine, robot, 1), 0);
  run(*engine, 10);
  EXPECT_EQ(told_mps(*engine, robot, 0), 0.2);
  EXPECT_EQ(told_mps(*engine, robot, 1), 0.5);
}

TEST(EngineControllers, OneThatHasFailedGivesNothingOfWhatItSaidLast) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.controllers[0] = share_of("slow", {{"share", 0.2}, {"throw_at", 11}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  const double x_m = engine->true_pose(robot).x;
  EXPECT_NEAR(x_m, 0.02, 1e-9);
  const auto failed = of_kind(run(*engine, 20), EventKind::kDriverFailed);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0].step, 10U);
  EXPECT_EQ(told_mps(*engine, robot), 0);
  EXPECT_EQ(engine->true_pose(robot).x, x_m);
}

}  // namespace
}  // namespace rave::sim::testing
