// SPDX-License-Identifier: Apache-2.0
#include "rave/base/names.hpp"
#include "rave/robot/program.hpp"

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
    if (name.empty() || name == raw_->sensors[i].name) return i;
    fitting.emplace_back(raw_->sensors[i].name);
  }
  return fail(ErrorCode::kNotFound,
              "the program wants a sensor of kind `{}`{}, which robot `{}` "
              "does not have; sensors of that kind: {}",
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
              "the program wants a controller that takes `{}`{}, which robot "
              "`{}` does not have; controllers that do: {}",
              to_string(kind), wanted(name), raw_->robot.name, join_names(fitting));
}

}  // namespace rave
