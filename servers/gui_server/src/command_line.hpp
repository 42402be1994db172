// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/bus.hpp"
#include "rave/bus/writer.hpp"
#include "rave/control/run_control.hpp"

namespace rave::gui_server {

/// Sends what people say many times a second to the robots of a run (topic rave/command). One owner
/// thread; waits for no process, and receives no answer.
class CommandLine {
 public:
  /// `robots`: the names of all, by id. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<CommandLine>> open(
      bus::BusConfig config, const std::vector<std::string>& robots);
  /// A kDrive. Errors: kNotFound (no such robot), kInvalidArgument (it has no author, or is none).
  Status send(const runtime::RunRequest& drive);

 private:
  CommandLine(std::unique_ptr<bus::Bus> bus, bus::Writer<bus::Command> commands)
      : bus_(std::move(bus)), commands_(std::move(commands)) {}

  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<bus::Command> commands_;
  std::map<std::string, std::uint32_t, std::less<>> ids_;
  std::uint64_t sent_ = 0;
};

}  // namespace rave::gui_server
