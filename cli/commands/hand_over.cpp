// SPDX-License-Identifier: Apache-2.0
#include "commands/hand_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <thread>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/base/table.hpp"
#include "rave/control/folder.hpp"
#include "rave/math/scalar.hpp"

namespace rave::cli {
namespace {

using control::Request;
using control::request_of;
using runtime::RunStatus;

constexpr auto kLook = std::chrono::milliseconds(50);
/// No more often than a process on the bus answers.
constexpr auto kLookFar = std::chrono::milliseconds(200);
/// A process on the bus may refuse this number of looks in a row.
constexpr int kMostMisses = 10;

Result<RunStatus> status_of(const std::string& local) { return AskedRun(local).status(); }

std::optional<RunStatus::HandOver> hand_over_of(const RunStatus& status, const std::string& robot) {
  for (const RunStatus::Robot& one : status.robots) {
    if (one.name == robot) return one.hand_over;
  }
  return std::nullopt;
}

using Has = std::function<bool(const RunStatus::Robot&)>;

bool has_one(const RunStatus& status, const Has& has) {
  return std::any_of(status.robots.begin(), status.robots.end(), has);
}

/// The process of a run that has what is asked for: in real time over several hosts that is the
/// host of the robot, and the name of the run, or no name, means that host. Errors: those of
/// find_run(), kState (more than one has it, or it is unknown whose hosts are here; then it
/// says how to choose, with the command's `option` for that).
Result<std::string> find_process_here(const std::string& word, std::string_view option,
                                      const Has& has) {
  auto run = control::find_run(word);
  // Where a manager runs elsewhere, its hosts are known by the scenario.
  std::string scenario = word;
  if (run) {
    const auto status = status_of(*run);
    const bool is_it = !status || has_one(*status, has) || run->find('@') != std::string::npos;
    if (is_it) return run;
    scenario = status->scenario;
  }
  RAVE_TRY_ASSIGN(const auto all, control::running_runs());
  std::vector<std::string_view> found;
  std::size_t runs = 0;
  for (const std::string& one : all) {
    // One that has just ended has nothing.
    const auto status = status_of(one);
    if (!status || !(scenario.empty() || status->scenario == scenario)) continue;
    const bool is_host = one.find('@') != std::string::npos;
    if (!is_host) ++runs;
    // With a run that was found, the hosts of it alone; without, every host that has it.
    if ((is_host || !run) && has_one(*status, has)) found.emplace_back(one);
  }
  if (found.empty()) return run;
  if (run && runs > 1) {
    return fail(ErrorCode::kState,
                "{} runs of `{}` are on this machine, and their hosts cannot be told apart: {}",
                runs, scenario, control::choose_one(found, option));
  }
  if (found.size() == 1) return std::string(found.front());
  return fail(ErrorCode::kState, "several processes match: {}", control::choose_one(found, option));
}

/// The same, or if there is none here on the bus.
Result<AskedRun> find_process(const std::string& word, std::string_view option,
                              const BusOptions& bus, const Has& has) {
  auto here = find_process_here(word, option, has);
  if (here) return AskedRun(*std::move(here));
  if (here.error().code != ErrorCode::kNotFound || AskedRun::may_be_here(word)) {
    return tl::unexpected(std::move(here).error());
  }
  return AskedRun::find_on_bus(word, bus,
                               [&has](const RunStatus& status) { return has_one(status, has); });
}

/// Waits for the end of the hand-over that was begun after `before`.
Result<int> await(const AskedRun& run, const std::string& robot,
                  const RunStatus::HandOver& before) {
  int misses = 0;
  for (;; std::this_thread::sleep_for(run.on_bus() ? kLookFar : kLook)) {
    RAVE_TRY_ASSIGN(const auto answer, run.ask(Request{}));
    if (!answer.good) {
      // Who is asked too much at once has not ended.
      if (run.on_bus() && ++misses < kMostMisses) continue;
      return refused(
          run, fmt::format("the hand-over of {} was requested, but its progress is unknown: {}; "
                           "see the log of that process",
                           robot, answer.text));
    }
    misses = 0;
    const auto now = hand_over_of(answer.status, robot);
    if (!now) return refused(run, "the run ended before the robot was handed over");
    // The process counts hand-overs. A change of a counter, not the present drivers, says that this
    // one is done: another request may have come before.
    if (now->made != before.made) {
      put(stdout, fmt::format("{}: {}: {}\n", run.name(), robot, now->last));
      return kGood;
    }
    if (now->refused != before.refused) return refused(run, robot + ": " + now->last);
  }
}

nlohmann::ordered_json json_of(const RunStatus::Robot& robot) {
  const RunStatus::Shadow& shadow = *robot.shadow;
  nlohmann::ordered_json json = {{"robot", robot.name},        {"running", shadow.running},
                                 {"since_s", shadow.since_s},  {"m", shadow.m},
                                 {"rad", shadow.rad},          {"most_m", shadow.most_m},
                                 {"most_rad", shadow.most_rad}};
  for (const auto& reading : shadow.readings) {
    json["readings"][reading.sensor] = {
        {"unit", reading.unit}, {"last", reading.last}, {"most", reading.most}};
  }
  return json;
}

void add_rows(const RunStatus& status, const RunStatus::Robot& robot, Table& table) {
  const RunStatus::Shadow& shadow = *robot.shadow;
  const std::string since =
      shadow.running ? fmt::format("{:.1f} s", status.sim_s - shadow.since_s) : "not running";
  table.rows.push_back({robot.name, "position", fmt::format("{:.3f} m", shadow.m),
                        fmt::format("{:.3f} m", shadow.most_m), since});
  table.rows.push_back({"", "heading", fmt::format("{:.1f} deg", rad_to_deg(shadow.rad)),
                        fmt::format("{:.1f} deg", rad_to_deg(shadow.most_rad)), ""});
  for (const auto& reading : shadow.readings) {
    const bool share = reading.unit == "share";
    const auto text = [share](double value) {
      return share ? fmt::format("{:.1f} %", 100 * value) : fmt::format("{:.3f} m", value);
    };
    table.rows.push_back({"", reading.sensor, text(reading.last), text(reading.most), ""});
  }
}

}  // namespace

Result<int> hand_over(const HandOverCommand& options) {
  const auto has = [&options](const RunStatus::Robot& robot) {
    return robot.name == options.robot && robot.hand_over;
  };
  RAVE_TRY_ASSIGN(const auto run, find_process(options.run, "--run", options.bus, has));
  RAVE_TRY_ASSIGN(const auto status, run.status());
  // Before the request, or a fast hand-over would be missed.
  const auto before = hand_over_of(status, options.robot).value_or(RunStatus::HandOver{});
  const Request request = request_of({request::HandOver{options.to}, options.robot});
  RAVE_TRY_ASSIGN(const auto answer, run.ask(request));
  if (!answer.good) return refused(run, answer.text);
  return await(run, options.robot, before);
}

Result<int> show_shadows(const ShadowCommand& options) {
  const auto has = [&options](const RunStatus::Robot& robot) {
    return (options.robot.empty() || robot.name == options.robot) && robot.shadow;
  };
  RAVE_TRY_ASSIGN(const auto run, find_process(options.run, {}, options.bus, has));
  if (options.reset) {
    return ask_and_tell(run, request_of({request::ResetShadow(), options.robot}));
  }
  RAVE_TRY_ASSIGN(const auto status, run.status());
  Table table;
  table.columns = {{"robot"},
                   {"difference"},
                   {"now", Align::kRight},
                   {"most", Align::kRight},
                   {"since", Align::kRight}};
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const RunStatus::Robot& robot : status.robots) {
    if (!has(robot)) continue;
    add_rows(status, robot, table);
    json.push_back(json_of(robot));
  }
  if (json.empty()) {
    return refused(run, options.robot.empty()
                            ? "no robot of the run has a shadow; set `shadow: true` and `twin:` in "
                              "its entry of the scenario"
                            : fmt::format("robot `{}` has no shadow", options.robot));
  }
  put(stdout, options.json ? json.dump(2) + "\n" : render_table(table));
  return kGood;
}

}  // namespace rave::cli
