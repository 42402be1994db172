// SPDX-License-Identifier: Apache-2.0
#include "rave/control/commands.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/control/host_leases.hpp"

namespace rave::control {
namespace {

using runtime::RunControl;
using runtime::RunRequest;
using Clock = std::chrono::steady_clock;

/// Drive commands that one process accepts per second, from all senders together; also the largest
/// burst.
constexpr double kMostInSecond = 5000;

/// Limits the commands that a process accepts: no more than its run can handle, and none that is
/// older than one already received.
class Intake {
 public:
  bool takes(const bus::Command& command, Clock::time_point now) {
    const double passed_s = std::chrono::duration<double>(now - since_).count();
    left_ = std::min(kMostInSecond, left_ + passed_s * kMostInSecond);
    since_ = now;
    if (left_ < 1) return false;
    std::uint64_t& newest = newest_[{command.writer, command.robot}];
    if (command.number <= newest && newest != 0) return false;
    // Limits the memory that a sender with invented writer ids can use.
    constexpr std::size_t kMostKnown = 100'000;
    if (newest_.size() > kMostKnown) newest_.clear();
    newest_[{command.writer, command.robot}] = command.number;
    left_ -= 1;
    return true;
  }

 private:
  double left_ = kMostInSecond;
  Clock::time_point since_ = Clock::now();
  std::map<std::pair<std::uint64_t, std::uint32_t>, std::uint64_t> newest_;
};

}  // namespace

bus::OnCommand commands_of(RunControl& control, const config::ExpandedScenario& scenario) {
  std::vector<std::string> robots;
  for (const config::ExpandedRobot& robot : scenario.robots) robots.push_back(robot.name);
  // shared_ptr because a std::function must be copyable, and it is shared with nothing else.
  const auto intake = std::make_shared<Intake>();
  return [&control, intake, robots = std::move(robots)](const bus::Command& command) {
    if (command.kind != rave_wire_COMMAND_VELOCITY || command.robot >= robots.size()) return;
    if (!intake->takes(command, Clock::now())) return;
    RunRequest drive;
    drive.kind = RunRequest::Kind::kDrive;
    drive.robot = robots[command.robot];
    drive.by = command.author;
    // This name stands for the terminal on the run's own machine, so commands from the bus may not
    // use it.
    if (drive.by == runtime::HostLeases::kTerminal) return;
    drive.v_mps = command.vx_mps;
    drive.w_radps = command.wz_radps;
    drive.page = command.lease;
    static_cast<void>(control.post(std::move(drive)));
  };
}

bus::Command drive_command(const RunRequest& drive, std::uint32_t robot, std::uint64_t number) {
  bus::Command command{};
  command.robot = robot;
  command.kind = rave_wire_COMMAND_VELOCITY;
  command.number = number;
  bus::put_text(command.author, drive.by);
  command.vx_mps = drive.v_mps;
  command.wz_radps = drive.w_radps;
  command.lease = drive.page;
  return command;
}

}  // namespace rave::control
