// SPDX-License-Identifier: Apache-2.0
#include "commands/control.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/math/scalar.hpp"
#include "rave/report/table.hpp"
#include "rave/run_control/client.hpp"
#include "rave/run_control/folder.hpp"

namespace rave::cli {
namespace {

using run_control::Request;

/// Asks one run and prints its answer.
int ask_run(const AskedRun& run, const Request& request) {
  const auto answer = run.ask(request);
  if (!answer) return complain(answer.error());
  if (!answer->good) {
    complain({ErrorCode::kState, fmt::format("{}: {}", run.name(), answer->text), {}});
    return kNotGood;
  }
  put(stdout, fmt::format("{}: {}\n", run.name(), answer->text));
  return kGood;
}

int find_and_ask(const std::string& word, const BusOptions& bus, const Request& request) {
  const auto run = AskedRun::find(word, bus);
  return run ? ask_run(*run, request) : complain(run.error());
}

Request request_of(Request::What what, const std::string& robot) {
  Request request;
  request.what = what;
  request.robot = robot;
  return request;
}

std::string pace_text(const robot_host::RunStatus& status) {
  if (status.live) return "live";
  return status.pace == 0 ? "max" : fmt::format("{}x", status.pace);
}

std::string state_text(const robot_host::RunStatus::Robot& robot) {
  std::string text = robot.stopped ? "stopped" : robot.armed ? "free" : "not armed";
  if (robot.hand_over) {
    const auto& hand_over = *robot.hand_over;
    text += fmt::format(" at ({:.3f}, {:.3f}) m, {:.1f} deg", hand_over.x_m, hand_over.y_m,
                        rad_to_deg(hand_over.yaw_rad));
    if (hand_over.under_way) text += ", being handed over";
  }
  if (robot.shadow && robot.shadow->running) {
    text += fmt::format(", shadow {:.3f} m away", robot.shadow->m);
  }
  return text;
}

std::string state_text(const robot_host::RunStatus& status) {
  std::size_t stopped = 0;
  std::size_t unarmed = 0;
  for (const auto& robot : status.robots) {
    stopped += robot.stopped ? 1 : 0;
    unarmed += robot.armed ? 0 : 1;
  }
  std::string text = status.paused ? "paused" : "running";
  if (stopped > 0) text += fmt::format(", {} stopped", stopped);
  if (unarmed > 0) text += fmt::format(", {} not armed", unarmed);
  return text;
}

report::Table runs_table() {
  report::Table table;
  table.columns = {
      {"run", report::Align::kLeft, false},     {"scenario", report::Align::kLeft, false},
      {"time", report::Align::kRight, false},   {"pace", report::Align::kRight, false},
      {"robots", report::Align::kRight, false}, {"state", report::Align::kLeft, false}};
  return table;
}

}  // namespace

int list_runs(const PsCommand& options) {
  const auto runs = run_control::running_runs();
  if (!runs) return complain(runs.error());
  report::Table table = runs_table();
  for (const std::string& run : *runs) {
    const auto answer = run_control::ask(run, request_of(Request::What::kStatus, ""));
    if (!answer) {
      // One that ended meanwhile is no more; one that is stuck is worth a line.
      if (answer.error().code == ErrorCode::kNotFound) continue;
      table.rows.push_back({run, "", "", "", "", answer.error().message});
      continue;
    }
    const robot_host::RunStatus& status = answer->status;
    if (status.scenario.empty()) {
      table.rows.push_back({run, "", "", "", "", "starting or ending"});
      continue;
    }
    table.rows.push_back(
        {run, status.scenario, fmt::format("{:.2f} of {} s", status.sim_s, status.duration_s),
         pace_text(status), fmt::format("{}", status.robots.size()), state_text(status)});
    if (!options.robots) continue;
    for (const auto& robot : status.robots) {
      table.rows.push_back({"", "  " + robot.name, "", "", robot.simulated ? "simulated" : "real",
                            state_text(robot)});
    }
  }
  put(stdout, table.rows.empty() ? "no run is under way\n" : report::render_table(table));
  return kGood;
}

int stop_robots(const StopCommand& options) {
  const Request request = request_of(Request::What::kStop, options.robot);
  if (!options.all) return find_and_ask(options.run, options.bus, request);
  if (!options.run.empty() || !options.robot.empty()) {
    return complain({ErrorCode::kInvalidArgument, "`--all` is every robot of every run", {}});
  }
  const auto runs = run_control::running_runs();
  if (!runs) return complain(runs.error());
  if (runs->empty()) return complain({ErrorCode::kNotFound, "no run is under way", {}});
  int code = kGood;
  for (const std::string& run : *runs) code = std::max(code, ask_run(AskedRun(run), request));
  return code;
}

int arm_robots(const ArmCommand& options) {
  const auto run = AskedRun::find(options.run, options.bus);
  if (!run) return complain(run.error());
  if (options.release) {
    const int code = ask_run(*run, request_of(Request::What::kRelease, options.robot));
    if (code != kGood) return code;
  }
  return ask_run(*run, request_of(Request::What::kArm, options.robot));
}

int set_parameter(const SetCommand& options) {
  const std::size_t first = options.words.size() == 4 ? 1 : 0;
  Request request = request_of(Request::What::kSet, options.words[first]);
  request.key = options.words[first + 1];
  request.value = options.words[first + 2];
  return find_and_ask(first == 1 ? options.words[0] : "", options.bus, request);
}

int hold_run(const HoldCommand& options) {
  Request request;
  request.count = options.count;
  switch (options.what) {
    case HoldCommand::What::kPause:
      request.what = Request::What::kPause;
      break;
    case HoldCommand::What::kResume:
      request.what = Request::What::kResume;
      break;
    case HoldCommand::What::kStep:
      request.what = Request::What::kStep;
      break;
  }
  return find_and_ask(options.run, options.bus, request);
}

}  // namespace rave::cli
