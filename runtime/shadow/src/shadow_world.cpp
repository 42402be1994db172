// SPDX-License-Identifier: Apache-2.0
#include "rave/shadow/shadow_world.hpp"

#include <algorithm>
#include <array>

#include "obstacle_order.hpp"
#include "rave/math/transform.hpp"

namespace rave::runtime {

// The twin runs in a lock-step of two "hosts" within one thread: one has the twin, the other one
// reports all robots of the run at their poses there. Robots of the run are of a type that is only
// placed, so the twin is stopped by them and never moves them.
namespace {

constexpr std::uint32_t kOwn = 0;
constexpr std::uint32_t kOthers = 1;
/// The readings of a real robot arrive slightly late.
constexpr Duration kHistory{1'000'000'000};

Command standing(CommandKind kind) {
  return kind == CommandKind::kVelocity ? velocity_command(0, 0) : Command{};
}

/// A controller that passes on commands that have already passed the robot's controllers and guard.
template <CommandKind kKind>
class Pass final : public Controller {
 public:
  static constexpr CommandKind kAccepts = kKind;
  static constexpr CommandKind kGives = kKind;
  Status start(const DeviceSetup& /*setup*/) override { return {}; }
  Command control(const ControlInput& input) override {
    return input.command.kind == kKind ? input.command : standing(kKind);
  }
};

const ControllerOps* pass_ops(CommandKind kind) {
  static const std::array kOps = {
      detail::controller_ops<Pass<CommandKind::kVelocity>>(),
      detail::controller_ops<Pass<CommandKind::kGoal>>(),
      detail::controller_ops<Pass<CommandKind::kJoint>>(),
      detail::controller_ops<Pass<CommandKind::kValues>>(),
      detail::controller_ops<Pass<CommandKind::kPedals>>(),
  };
  for (const ControllerOps& ops : kOps) {
    if (ops.gives == kind) return &ops;
  }
  return &kOps.front();
}

/// The last commands to the actuators of the robot, in their order.
using Orders = std::vector<Command>;

/// A program that executes the given orders.
class Obedient final : public sim::ProgramProcess {
 public:
  explicit Obedient(std::shared_ptr<const Orders> orders) : orders_(std::move(orders)) {}
  Status begin(const DecideItem& /*item*/) override { return {}; }
  Status end(const DecideItem& item) override {
    std::ranges::copy(*orders_, item.commands);
    return {};
  }

 private:
  std::shared_ptr<const Orders> orders_;
};

/// The kind of command that the first controller of an actuator produces.
CommandKind kind_for(const sim::RobotType& type, std::uint32_t actuator) {
  for (const sim::ControllerSpec& controller : type.controllers) {
    if (controller.actuator == actuator) return controller.ops->gives;
  }
  return CommandKind::kVelocity;
}

/// Removes everything that decides from the twin: its commands are decided already.
void obey(const std::shared_ptr<const Orders>& orders, sim::RobotType& type) {
  std::vector<sim::ControllerSpec> controllers;
  for (std::uint32_t a = 0; a < type.actuators.size(); ++a) {
    sim::ControllerSpec& controller = controllers.emplace_back();
    controller.name = type.actuators[a].name;
    controller.driver = "orders";
    controller.ops = pass_ops(kind_for(type, a));
    controller.accepts = controller.ops->gives;
    controller.actuator = a;
  }
  // The commands have passed the guard of the real robot. A second guard would limit them again, by
  // the poses of the twin.
  type.guard.reset();
  type.controllers = std::move(controllers);
  type.transmitters.clear();
  type.communicators.clear();
  sim::ProgramSpec program;
  program.driver = "orders";
  program.isolate = [orders](const ProgramSetup&) -> Result<std::unique_ptr<sim::ProgramProcess>> {
    return std::make_unique<Obedient>(orders);
  };
  type.program = std::move(program);
}

/// The type of a robot that is placed at a given pose.
sim::RobotType placed_type() {
  sim::RobotType type;
  type.name = "placed";
  type.simulated = false;
  type.pose_from = 0;
  return type;
}

/// The parts of a type that an authority uses.
sim::RobotType outline_of(const sim::RobotType& type) {
  sim::RobotType outline;
  outline.name = type.name;
  outline.pose_from = type.pose_from;
  return outline;
}

sim::EngineSpec shadow_spec(const sim::EngineSpec& run, RobotId robot, sim::RobotType type) {
  sim::EngineSpec spec;
  spec.world = run.world;
  // The layer follows from the drivers, as for a robot of the run.
  spec.world.robots[robot.value()].layer = Layer::kSimulatedRobots;
  spec.types.push_back(std::move(type));
  spec.types.push_back(placed_type());
  for (std::uint32_t r = 0; r < run.robots.size(); ++r) {
    const sim::RobotSpec& its = run.robots[r];
    spec.robots.push_back({its.name, its.team, r == robot.value() ? 0U : 1U, its.X_WR});
  }
  spec.step = run.step;
  spec.seed = run.seed;
  spec.history = kHistory;
  spec.local = {robot};
  spec.own_authority = true;
  return spec;
}

Status check_virtual(const sim::EngineSpec& spec, RobotId robot, const sim::RobotType& type) {
  for (const sim::SensorSpec& sensor : type.sensors) {
    if (sensor.virtual_ops != nullptr) continue;
    return fail(ErrorCode::kInvalidArgument,
                "`shadow` of robot `{}`: sensor `{}` of its simulated twin uses hardware (driver "
                "`{}`), which exists only once",
                spec.robots[robot.value()].name, sensor.name, sensor.driver);
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<ShadowWorld>> ShadowWorld::create(const sim::Engine& engine, RobotId robot,
                                                         sim::RobotType simulated, LogSink* log) {
  const sim::EngineSpec& run = engine.spec();
  RAVE_TRY(check_virtual(run, robot, simulated));
  std::unique_ptr<ShadowWorld> shadow(new ShadowWorld(robot, log));
  shadow->orders_ = std::make_shared<Orders>();
  for (std::uint32_t a = 0; a < simulated.actuators.size(); ++a) {
    shadow->orders_->push_back(standing(kind_for(simulated, a)));
  }
  obey(shadow->orders_, simulated);
  std::vector<std::uint32_t> host_of(run.robots.size(), kOthers);
  host_of[robot.value()] = kOwn;
  RAVE_TRY_ASSIGN(shadow->authority_,
                  sim::WorldAuthority::create(shadow_spec(run, robot, outline_of(simulated)),
                                              std::move(host_of)));
  RAVE_TRY_ASSIGN(shadow->engine_,
                  sim::Engine::create(shadow_spec(run, robot, std::move(simulated))));
  shadow->own_.host = kOwn;
  shadow->others_.host = kOthers;
  return shadow;
}

Status ShadowWorld::step(const sim::Engine& engine, std::span<const sim::Event> beside,
                         std::optional<Pose2> start, bool driven) {
  // The twin proposes with the commands of the previous step of the run, which listen() has taken.
  RAVE_TRY(engine_->propose(own_));
  const std::uint64_t done = engine.steps_done() - 1;
  // Only in the first step of a host that joined a run in progress.
  const bool later = own_.step < done;
  if (later) RAVE_TRY(begin_at(done));
  mirror_obstacles(engine, engine.events());
  mirror_obstacles(engine, beside);
  report_others(engine);
  const std::array<const sim::HostReport*, 2> reports = {&own_, &others_};
  const std::size_t hosts = engine.spec().robots.size() > 1 ? 2 : 1;
  RAVE_TRY(authority_->step(std::span(reports).first(hosts), world_));
  if (log_ != nullptr) {
    for (const sim::InputRefusal& refusal : authority_->refusals()) {
      log_->warn("shadow", "its world differs from that of the run: {}", refusal.text);
    }
  }
  if (start) {
    // Into the world of this step, after the authority has computed it and before the engine sees
    // it. So the twin senses from the new pose in the same step.
    put(*start);
    RAVE_TRY(authority_->resume(world_, authority_->state()));
  }
  RAVE_TRY(later ? engine_->join(world_, {}) : engine_->apply(world_));
  listen(engine, driven);
  return {};
}

/// Acts as if all robots had stood at their starting poses until `step`: the host of the robot
/// joined later.
Status ShadowWorld::begin_at(std::uint64_t step) {
  const sim::EngineSpec& spec = authority_->spec();
  sim::WorldStep before;
  before.begin(step - 1, spec.robots.size());
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const Pose2& X_WR = spec.robots[r].X_WR;
    before.x_m[r] = X_WR.x;
    before.y_m[r] = X_WR.y;
    before.yaw_rad[r] = X_WR.yaw;
    before.flags[r] = RobotId(r) == robot_ ? sim::WorldStep::kPresent : 0;
  }
  RAVE_TRY(authority_->resume(before, {}));
  own_.step = step;
  own_.proposals.clear();
  own_.proposals.robots.push_back(robot_.value());
  own_.proposals.vx_mps.push_back(0);
  own_.proposals.vy_mps.push_back(0);
  own_.proposals.wz_radps.push_back(0);
  return {};
}

void ShadowWorld::mirror_obstacles(const sim::Engine& engine, std::span<const sim::Event> events) {
  using Kind = sim::ObstacleChange::Kind;
  for (const sim::Event& event : obstacle_events_in_order(events)) {
    const bool added = event.kind == sim::EventKind::kObstacleAdded;
    const bool removed = event.kind == sim::EventKind::kObstacleRemoved;
    const world::Obstacle* const obstacle = engine.spec().world.obstacle(event.other.value());
    sim::WorldInput input;
    input.author = sim::Author::kRun;
    sim::ObstacleChange& change = input.action.emplace<sim::ObstacleChange>();
    change.kind = added ? Kind::kAdd : removed ? Kind::kRemove : Kind::kMove;
    change.name = obstacle->body.name;
    // Obstacles of the start have the same number in both worlds. Added ones may not, because the
    // shadow began later or refused one; they are found by name.
    if (event.other.value() < engine.spec().world.obstacles.size()) change.id = event.other;
    change.X_WB = obstacle->X_WB;
    if (added) change.body = obstacle->body;
    const auto asked = authority_->ask(std::move(input));
    if (asked || log_ == nullptr) continue;
    log_->warn("shadow", "its world differs from that of the run: {}", asked.error().text());
  }
}

void ShadowWorld::report_others(const sim::Engine& engine) {
  const world::Snapshot& run = engine.snapshot();
  others_.begin(own_.step);
  for (std::uint32_t r = 0; r < engine.spec().robots.size(); ++r) {
    const RobotId other(r);
    if (other == robot_) continue;
    const world::RobotState state = run.robot(other);
    const Twist2& over_ground = state.velocity_W;
    // The snapshot has velocities over ground in world axes; a report has them in the frame of the
    // body.
    const Vec2 v = rotate_back(run.turn_WR(other), {over_ground.vx, over_ground.vy});
    sim::ReportedPose pose;
    pose.pose = {state.X_WR.x, state.X_WR.y, state.X_WR.yaw, 0, 0};
    pose.velocity = {v.x, v.y, over_ground.wz};
    pose.stamp = run.time();
    pose.known = state.present;
    others_.poses.push_back({other, pose});
    if (state.present) others_.samples.push_back({other, run.time(), state.X_WR});
  }
}

/// Places the twin in the world of this step, as if it had moved there by itself.
void ShadowWorld::put(const Pose2& X_WR) {
  const std::uint32_t r = robot_.value();
  world_.x_m[r] = X_WR.x;
  world_.y_m[r] = X_WR.y;
  world_.yaw_rad[r] = X_WR.yaw;
  const auto is_own = [this](const auto& entry) { return entry.robot == robot_; };
  std::erase_if(world_.pushed, is_own);
  std::erase_if(world_.touches, is_own);
}

void ShadowWorld::listen(const sim::Engine& engine, bool driven) {
  const sim::RobotType& type = engine_->spec().types[0];
  for (std::uint32_t a = 0; a < orders_->size(); ++a) {
    const CommandKind kind = type.controllers[a].accepts;
    const Command told = driven ? engine.actuator_command(robot_, a) : Command{};
    (*orders_)[a] = told.kind == kind ? told : standing(kind);
  }
}

std::optional<Pose2> ShadowWorld::pose_at(SimTime stamp) const {
  const auto pose = engine_->pose_at(robot_, stamp);
  if (!pose) return std::nullopt;
  return *pose;
}

}  // namespace rave::runtime
