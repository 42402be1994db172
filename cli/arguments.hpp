// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "commands/bench.hpp"
#include "commands/check.hpp"
#include "commands/control.hpp"
#include "commands/describe.hpp"
#include "commands/doctor.hpp"
#include "commands/drivers.hpp"
#include "commands/edit.hpp"
#include "commands/end.hpp"
#include "commands/export.hpp"
#include "commands/gui.hpp"
#include "commands/hand_over.hpp"
#include "commands/hosts.hpp"
#include "commands/info.hpp"
#include "commands/keys.hpp"
#include "commands/new.hpp"
#include "commands/order.hpp"
#include "commands/people.hpp"
#include "commands/play.hpp"
#include "commands/report.hpp"
#include "commands/run.hpp"
#include "commands/schema.hpp"
#include "commands/top.hpp"
#include "commands/verify.hpp"

namespace rave::cli {

struct VersionCommand {};

/// The command line ends here: help was printed, or a complaint.
struct Finished {
  int exit_code = 0;
};

using Command =
    std::variant<Finished, RunCommand, RobotCommand, EnvCommand, CheckCommand, DriversCommand,
                 DescribeCommand, NewCommand, SchemaCommand, InfoCommand, VerifyCommand,
                 PlayCommand, ExportCommand, GapCommand, GuiCommand, PsCommand, StopCommand,
                 ArmCommand, SetCommand, HandOverCommand, ShadowCommand, EditCommand, OrderCommand,
                 HoldCommand, EndCommand, BenchSwarmCommand, BenchCompareCommand, KeysNewCommand,
                 KeysAddCommand, KeysShowCommand, KeysWebCommand, KeysLineCommand, PeopleCommand,
                 TopCommand, DoctorCommand, VersionCommand>;

/// Reads the command line. Prints help and complaints itself.
[[nodiscard]] Command parse_arguments(int argc, const char* const* argv);

}  // namespace rave::cli
