// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include "rave/control/commands.hpp"

namespace rave::gui_server {

Result<std::unique_ptr<CommandLine>> CommandLine::open(bus::BusConfig config,
                                                       const std::vector<std::string>& robots) {
  // No process of the run may take it for a part of the run.
  config.anonymous = true;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto commands, bus::Writer<bus::Command>::create(*bus));
  std::unique_ptr<CommandLine> line(new CommandLine(std::move(bus), std::move(commands)));
  for (std::uint32_t r = 0; r < robots.size(); ++r) line->ids_.emplace(robots[r], r);
  return line;
}

Status CommandLine::send(const runtime::RunRequest& drive) {
  const auto id = ids_.find(drive.robot);
  if (id == ids_.end()) {
    return fail(ErrorCode::kNotFound, "there is no robot `{}`", drive.robot);
  }
  bus::Command command = control::drive_command(drive, id->second, ++sent_);
  return commands_.write(command);
}

}  // namespace rave::gui_server
