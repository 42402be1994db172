// SPDX-License-Identifier: Apache-2.0
#include "commands/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/base/table.hpp"
#include "rave/base/thread.hpp"
#include "rave/control/folder.hpp"
#include "rave/math/scalar.hpp"

namespace rave::cli {
namespace {

using control::Request;
using control::request_of;

/// Asks all; those here at once, so that one that stands keeps no stop from the others.
std::vector<Reply> ask_all(const std::vector<AskedRun>& runs, const Request& request) {
  std::vector<std::future<Result<control::Answer>>> answers;
  for (const AskedRun& run : runs) {
    const auto ask = [&run, &request] { return run.ask(request); };
    // What is on the bus is asked by its one owner.
    answers.push_back(run.on_bus() ? std::async(std::launch::deferred, ask) : start_beside(ask));
  }
  std::vector<Reply> replies;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    replies.push_back({runs[i].name(), answers[i].get()});
  }
  return replies;
}

/// Prints them. What one process has done for the robot of this name is no concern of others.
int tell(const std::vector<Reply>& replies, const std::string& robot) {
  const bool done = !robot.empty() && std::ranges::any_of(replies, [](const Reply& reply) {
    return reply.answer && reply.answer->good;
  });
  int code = kGood;
  for (const auto& [name, answer] : replies) {
    if (answer && answer->good) {
      put(stdout, fmt::format("{}: {}\n", name, answer->text));
    } else if (!done) {
      Error why = answer ? Error{ErrorCode::kState, answer->text, {}} : answer.error();
      const int found = complain(std::move(why).with_context(name));
      code = std::max(code, answer ? int{kNotGood} : found);
    }
  }
  return code;
}

/// How many robots the processes say they have; nothing if one does not say it.
std::optional<std::size_t> robots_of(const std::vector<AskedRun>& runs) {
  std::size_t robots = 0;
  for (const AskedRun& run : runs) {
    const auto status = run.status();
    if (!status) return std::nullopt;
    robots += status->robots.size();
  }
  return robots;
}

/// Asks the processes that stop and arm the robots of a run, and prints what came of it. The
/// manager of a run in real time is asked if it has more robots than they: it says where to ask.
Result<int> ask_controllers(const AskedRun& run, const Request& request, bool sure) {
  RAVE_TRY_ASSIGN(const auto controllers, run.controllers(sure));
  std::vector<Reply> replies = ask_all(controllers, request);
  // In lock-step the manager stops all robots itself. In real time each host stops its own.
  const bool hosts = controllers.front().name() != run.name();
  if (hosts && robots_of(controllers) != robots_of({run})) {
    replies.push_back({run.name(), run.ask(request)});
  }
  return tell(replies, request.run.robot);
}

std::string pace_text(const runtime::RunStatus& status) {
  if (status.live) return "live";
  return status.pace == 0 ? "max" : fmt::format("{}x", status.pace);
}

std::string state_text(const runtime::RunStatus::Robot& robot) {
  // A stop first: it also holds for a robot that is not armed, and is released separately.
  std::string text = robot.stopped ? "stopped" : robot.armed ? "" : "not armed";
  if (!robot.lacks.empty()) text += (text.empty() ? "" : ", ") + robot.lacks;
  if (text.empty()) text = robot.elsewhere ? "its host does not answer" : "free";
  if (robot.hand_over) {
    const auto& hand_over = *robot.hand_over;
    text += fmt::format(" at ({:.3f}, {:.3f}) m, {:.1f} deg", hand_over.x_m, hand_over.y_m,
                        rad_to_deg(hand_over.yaw_rad));
    if (hand_over.under_way) text += ", being handed over";
  }
  if (!robot.order.empty()) text += ", " + robot.order;
  if (!robot.lease.empty()) text += fmt::format(", `{}` drives it", robot.lease);
  if (robot.shadow && robot.shadow->running) {
    text += fmt::format(", shadow {:.3f} m away", robot.shadow->m);
  }
  return text;
}

std::string state_text(const runtime::RunStatus& status) {
  std::size_t stopped = 0;
  std::size_t unarmed = 0;
  std::size_t lacking = 0;
  for (const auto& robot : status.robots) {
    stopped += robot.stopped ? 1 : 0;
    unarmed += robot.armed ? 0 : 1;
    if (!robot.lacks.empty()) ++lacking;
  }
  std::string text = status.paused ? "paused" : "running";
  if (stopped > 0) text += fmt::format(", {} stopped", stopped);
  if (unarmed > 0) text += fmt::format(", {} not armed", unarmed);
  if (lacking > 0) text += fmt::format(", {} cannot move", lacking);
  if (!status.waits_for.empty()) text += ", waiting for " + status.waits_for;
  return text;
}

Table runs_table(bool with_machines) {
  Table table;
  table.columns = {{"run"},
                   {"scenario"},
                   {"time", Align::kRight},
                   {"pace", Align::kRight},
                   {"robots", Align::kRight},
                   {"state"}};
  if (with_machines) table.columns.push_back({"machine"});
  return table;
}

/// A line of `rave ps`. `machine`: nothing if no run has one.
void add_row(Table& table, std::vector<TableCell> row, const std::string& machine) {
  if (row.size() < table.columns.size()) row.emplace_back(machine);
  table.rows.push_back(std::move(row));
}

std::string time_text(const runtime::RunStatus& status) {
  if (status.duration_s <= 0) return fmt::format("{:.2f} s", status.sim_s);
  return fmt::format("{:.2f} of {} s", status.sim_s, status.duration_s);
}

/// What `rave ps` says of one run.
void add_run(Table& table, const std::string& run, const Result<runtime::RunStatus>& answer,
             const std::string& machine, bool robots) {
  if (!answer) return add_row(table, {run, "", "", "", "", answer.error().message}, machine);
  const runtime::RunStatus& status = *answer;
  if (status.scenario.empty()) {
    return add_row(table, {run, "", "", "", "", "starting or ending"}, machine);
  }
  add_row(table,
          {run, status.scenario, time_text(status), pace_text(status),
           fmt::format("{}", status.robots.size()), state_text(status)},
          machine);
  if (!robots) return;
  for (const auto& robot : status.robots) {
    add_row(
        table,
        {"", "  " + robot.name, "", "", robot.simulated ? "simulated" : "real", state_text(robot)},
        "");
  }
}

/// Here or on the bus. Only who releases or arms has to be sure whom it is done to.
Result<int> stop_run(const StopCommand& options, const Request& request) {
  if (!AskedRun::may_be_here(options.run)) {
    const auto replies = AskedRun::ask_each_on_bus(options.run, options.bus, request);
    if (replies && !replies->empty()) return tell(*replies, options.robot);
  }
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  return ask_controllers(run, request, false);
}

}  // namespace

Result<int> list_runs(const PsCommand& options) {
  RAVE_TRY_ASSIGN(const auto runs, control::running_runs());
  const bool network = options.network || options.bus.says_where();
  Table table = runs_table(network);
  std::vector<SeenRun> here;
  for (const std::string& run : runs) {
    auto status = AskedRun(run).status();
    // One that ended meanwhile is no more; one that is stuck is worth a line.
    if (!status && status.error().code == ErrorCode::kNotFound) continue;
    here.push_back({run, "this one", std::move(status)});
  }
  for (SeenRun& run : here) {
    for (const SeenRun& host : here) {
      if (&host != &run && run.status && host.status) complete(*run.status, *host.status);
    }
    add_run(table, run.name, run.status, run.machines, options.robots);
  }
  int code = kGood;
  if (network) {
    const auto seen = AskedRun::all_on_bus(options.bus);
    // What runs here is worth telling all the same.
    if (!seen) code = complain(seen.error());
    for (const SeenRun& run : seen.value_or(std::vector<SeenRun>{})) {
      add_run(table, run.name, run.status, run.machines, options.robots);
    }
  }
  put(stdout, table.rows.empty() ? "no run is in progress\n" : render_table(table));
  return code;
}

Result<int> stop_robots(const StopCommand& options) {
  const Request request = request_of({request::Stop(), options.robot});
  if (!options.all) return stop_run(options, request);
  if (!options.run.empty() || !options.robot.empty() || options.bus.says_where()) {
    return fail(ErrorCode::kInvalidArgument,
                "--all stops only runs on this machine; stop a run of other machines by its name "
                "(`rave ps --network` lists them)");
  }
  RAVE_TRY_ASSIGN(const auto runs, control::running_runs());
  if (runs.empty()) {
    return fail(ErrorCode::kNotFound,
                "no run is in progress on this machine; stop a run of other machines by its name "
                "(`rave ps --network` lists them)");
  }
  std::vector<AskedRun> all;
  for (const std::string& run : runs) all.emplace_back(run);
  std::vector<Reply> replies = ask_all(all, request);
  // In real time a manager has no robots of its own, and its hosts have been asked.
  std::erase_if(replies, [&replies](const Reply& reply) {
    if (!reply.answer || reply.answer->good) return false;
    const auto own = AskedRun(reply.name).controllers(false);
    return own && std::ranges::all_of(*own, [&](const AskedRun& run) {
             return run.name() != reply.name &&
                    std::ranges::any_of(
                        replies, [&](const Reply& other) { return other.name == run.name(); });
           });
  });
  return tell(replies, "");
}

Result<int> arm_robots(const ArmCommand& options) {
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  if (options.release) {
    const Request release = request_of({request::Release(), options.robot});
    // Release first: if it fails, nothing is armed.
    RAVE_TRY_ASSIGN(const int code, ask_controllers(run, release, true));
    if (code != kGood) return code;
  }
  return ask_controllers(run, request_of({request::Arm(), options.robot}), true);
}

Result<int> set_parameter(const SetCommand& options) {
  const Request request = request_of({request::Set{options.key, options.value}, options.robot});
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  return ask_and_tell(run, request);
}

Result<int> hold_run(const HoldCommand& options) {
  Request request;
  request.own = options.what;
  if (auto* const step = std::get_if<control::Step>(&*request.own)) step->count = options.count;
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  return ask_and_tell(run, request);
}

}  // namespace rave::cli
