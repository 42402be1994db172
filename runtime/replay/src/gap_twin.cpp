// SPDX-License-Identifier: Apache-2.0
#include "gap_twin.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "rave/assemble/build.hpp"
#include "rave/sim/random_devices.hpp"

namespace rave::runtime {
namespace {

/// An instance of a driver in memory owned by this object.
class Instance {
 public:
  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() {
    if (made_) ops_->destroy(memory_);
    std::free(memory_);
  }
  Status make(const InstanceOps& ops) {
    ops_ = &ops;
    // At least a cache line. aligned_alloc() requires a multiple of the alignment as size.
    const std::size_t alignment = ops.alignment < 64 ? 64 : ops.alignment;
    const std::size_t bytes = (ops.size + alignment - 1) / alignment * alignment;
    memory_ = std::aligned_alloc(alignment, bytes == 0 ? alignment : bytes);
    if (memory_ == nullptr) return fail(ErrorCode::kIo, "out of memory: {} bytes", bytes);
    ErrorText error;
    if (ops.construct(memory_, &error) != 0) return fail(ErrorCode::kPlugin, "{}", error.text);
    made_ = true;
    return {};
  }
  [[nodiscard]] void* get() const noexcept { return memory_; }

 private:
  const InstanceOps* ops_ = nullptr;
  void* memory_ = nullptr;
  bool made_ = false;
};

/// A scenario with only this robot and the parts that move it.
config::ExpandedScenario alone(config::RobotFile robot, const std::filesystem::path& file,
                               double step_s, std::uint64_t seed) {
  config::ExpandedScenario scenario;
  scenario.scenario.name = codec::Located<std::string>("twin");
  scenario.scenario.step_s = codec::Located<double>(step_s);
  scenario.scenario.seed = seed;
  // Without sensors and program no hardware is opened and no other robot is needed.
  robot.sensors.clear();
  robot.controllers.clear();
  robot.program.reset();
  robot.pose_from.reset();
  config::RobotGroup& group = scenario.groups.emplace_back();
  group.name = codec::Located<std::string>("twin", robot.body.where);
  group.file = file.string();
  group.robot = std::move(robot);
  scenario.robots.push_back({"twin", 0, config::PoseFile{}});
  return scenario;
}

}  // namespace

struct GapTwin::Impl {
  BuiltScenario built;  ///< Owns the parameters that the instance was started with.
  const sim::ActuatorSpec* actuator = nullptr;
  std::uint32_t device = 0;
  CommandKind accepts = CommandKind::kNone;
  Instance instance;
  std::uint64_t seed = 0;
  RobotId id;
  double step_s = 0;
  Twist2 velocity;
};

GapTwin::GapTwin(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
GapTwin::GapTwin(GapTwin&&) noexcept = default;
GapTwin& GapTwin::operator=(GapTwin&&) noexcept = default;
GapTwin::~GapTwin() = default;

const std::string& GapTwin::driver() const noexcept { return impl_->actuator->driver; }
CommandKind GapTwin::accepts() const noexcept { return impl_->accepts; }

Result<GapTwin> GapTwin::make(config::RobotFile robot, const std::filesystem::path& file,
                              double step_s, std::uint64_t seed, RobotId id,
                              plugin::Catalogue& catalogue) {
  // Real devices are not opened; they may be absent.
  constexpr std::array kVirtual = {DriverKind::kVirtualActuator};
  const auto found = std::ranges::find_if(robot.actuators, [&](const auto& actuator) {
    return catalogue.find(kVirtual, actuator.driver.value).has_value();
  });
  if (found == robot.actuators.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "{} has no simulated actuator, so it cannot be a twin; give the file of a "
                "simulated robot with --twin",
                file.empty() ? "the robot in the recording" : fmt::format("`{}`", file.string()));
  }
  // The place of the device in the file determines its random numbers.
  const auto device = static_cast<std::uint32_t>(found - robot.actuators.begin());
  robot.actuators = {config::ActuatorFile(*found)};
  auto impl = std::make_unique<Impl>();
  RAVE_TRY_ASSIGN(impl->built,
                  build(alone(std::move(robot), file, step_s, seed), catalogue, BuildOptions{}));
  impl->actuator = &impl->built.spec.types.front().actuators.front();
  impl->device = device | sim::kActuatorDevice;
  RAVE_TRY_ASSIGN(const auto* const driver, catalogue.find(kVirtual, impl->actuator->driver));
  impl->accepts = static_cast<CommandKind>(driver->info.data_kind);
  impl->seed = seed;
  impl->id = id;
  impl->step_s = impl->built.spec.step.seconds();
  RAVE_TRY(impl->instance.make(impl->actuator->virtual_ops->instance));
  DeviceSetup setup;
  setup.robot.name = "twin";
  setup.robot.id = id.value();
  setup.robot.radius_m = impl->built.spec.world.robots.front().radius_m();
  setup.robot.seed = seed;
  setup.params = impl->actuator->params.values().data();
  setup.param_count = impl->actuator->params.values().size();
  setup.step_s = impl->step_s;
  ErrorText error;
  if (impl->actuator->virtual_ops->start(impl->instance.get(), &setup, &error) != 0) {
    return fail(ErrorCode::kPlugin, "driver `{}`: {}", impl->actuator->driver, error.text);
  }
  return GapTwin(std::move(impl));
}

Result<Twist2> GapTwin::propose(const Command& command, std::uint64_t step) {
  Impl& twin = *impl_;
  const MotionInput input{command,
                          twin.velocity,
                          twin.step_s,
                          twin.seed,
                          twin.id.value(),
                          twin.device,
                          static_cast<std::uint32_t>(step),
                          0};
  std::uint8_t failed = 0;
  ErrorText error;
  Twist2 output;
  twin.actuator->virtual_ops->propose(twin.instance.get(), 0, &input, &output, 1, &failed, &error);
  if (failed != 0) {
    return fail(ErrorCode::kPlugin, "driver `{}`: {}", twin.actuator->driver, error.text);
  }
  // The actuator's dynamics depend on the velocity before, which nothing limits here: the twin is
  // alone and touches nothing.
  twin.velocity = output;
  return output;
}

}  // namespace rave::runtime
