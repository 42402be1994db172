// SPDX-License-Identifier: Apache-2.0
// How a program finds its sensors, controllers and communicators at the start.
#include "rave/robot/setup.hpp"

#include "rave/base/names.hpp"

namespace rave {
namespace {

std::string wanted(std::string_view name) {
  return name.empty() ? std::string() : fmt::format(" named `{}`", name);
}

}  // namespace

Result<std::uint32_t> Setup::find_sensor(ReadingKind kind, std::string_view name) const {
  std::vector<std::string_view> fitting;
  for (std::uint32_t i = 0; i < raw_->sensor_count; ++i) {
    if (raw_->sensors[i].kind != kind) continue;
    // Without a name the first of the kind: most robots have one.
    if (name.empty() || name == raw_->sensors[i].name) return i;
    fitting.emplace_back(raw_->sensors[i].name);
  }
  return fail(ErrorCode::kNotFound,
              "robot `{2}` has no sensor of kind `{0}`{1}, which its program requires; "
              "sensors of that kind: {3}",
              to_string(kind), wanted(name), raw_->robot.name, join_names(fitting));
}

Result<ControllerHandle> Setup::controller(CommandKind kind, std::string_view name) const {
  std::vector<std::string_view> fitting;
  for (std::uint32_t i = 0; i < raw_->controller_count; ++i) {
    if (raw_->controllers[i].accepts != kind) continue;
    if (name.empty() || name == raw_->controllers[i].name) return ControllerHandle(i);
    fitting.emplace_back(raw_->controllers[i].name);
  }
  return fail(ErrorCode::kNotFound,
              "robot `{2}` has no controller that accepts `{0}`{1}, which its program "
              "requires; controllers that do: {3}",
              to_string(kind), wanted(name), raw_->robot.name, join_names(fitting));
}

Result<CommunicatorHandle> Setup::communicator(std::string_view name) const {
  std::vector<std::string_view> all;
  for (std::uint32_t i = 0; i < raw_->communicator_count; ++i) {
    const CommunicatorInfo& info = raw_->communicators[i];
    if (name.empty() || name == info.name) return CommunicatorHandle(i, &info);
    all.emplace_back(info.name);
  }
  return fail(ErrorCode::kNotFound,
              "robot `{1}` has no communicator{0}, which its program requires; it has: {2}",
              wanted(name), raw_->robot.name, join_names(all));
}

Result<std::uint32_t> Setup::robot_id(std::string_view name) const {
  const std::span<const char* const> names(raw_->robot_names, raw_->robot_count);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i]) return static_cast<std::uint32_t>(i);
  }
  const std::vector<std::string_view> all(names.begin(), names.end());
  return fail(ErrorCode::kNotFound, "there is no robot `{}`{}", name, suggestion(name, all));
}

}  // namespace rave
