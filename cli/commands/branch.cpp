// SPDX-License-Identifier: Apache-2.0
#include "commands/branch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "commands/run.hpp"
#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/table.hpp"
#include "rave/config/world_file.hpp"
#include "rave/replay/branch.hpp"
#include "rave/replay/run_diff.hpp"
#include "run_report.hpp"
#include "run_start.hpp"

namespace rave::cli {
namespace {

Result<request::Request> set_of(std::string_view words) {
  const std::size_t dot = words.find('.');
  const std::size_t equals = words.find('=');
  if (dot == std::string_view::npos || equals == std::string_view::npos || dot == 0 ||
      dot + 1 >= equals) {
    return fail(ErrorCode::kInvalidArgument,
                "--set: found `{}`, expected ROBOT.KEY=VALUE, such as "
                "prey.program.max_speed_mps=0.1",
                words);
  }
  request::Request request;
  request.action = request::Set{std::string(words.substr(dot + 1, equals - dot - 1)),
                                std::string(words.substr(equals + 1))};
  request.robot = words.substr(0, dot);
  return request;
}

Result<std::vector<request::Request>> requests_of(const BranchCommand& options) {
  std::vector<request::Request> requests;
  for (const std::string& words : options.set) {
    RAVE_TRY_ASSIGN(auto request, set_of(words));
    requests.push_back(std::move(request));
  }
  for (const std::string& json : options.edit) {
    RAVE_TRY_ASSIGN(auto edit, config::read_edit(json, "--edit"));
    request::Request request;
    request.action = request::Edit{std::move(edit)};
    requests.push_back(std::move(request));
  }
  return requests;
}

void put_first(const runtime::RunDifference& difference) {
  const std::string robot =
      difference.robot.empty() ? "" : fmt::format("robot {}, ", difference.robot);
  put(stdout, fmt::format("they part in step {} ({:.3f} s): {}{}\n  {}\n", difference.step,
                          difference.time_s, robot, difference.channel, difference.text));
}

std::string distances(const runtime::RunDiff& diff) {
  Table table;
  table.columns = {{"robot"},
                   {"apart from", Align::kRight},
                   {"at the end", Align::kRight},
                   {"at most", Align::kRight},
                   {"then", Align::kRight}};
  for (const runtime::RobotDistance& robot : diff.robots) {
    const std::string from = robot.from_s ? fmt::format("{:.2f} s", *robot.from_s) : "never";
    table.rows.push_back({robot.robot, from, fmt::format("{:.3f} m", robot.last_m),
                          fmt::format("{:.3f} m", robot.most_m),
                          robot.from_s ? fmt::format("{:.2f} s", robot.most_at_s) : ""});
  }
  TableOptions options;
  options.ansi = terminal_of(stdout).colour;
  return render_table(table, options);
}

}  // namespace

Result<int> branch(const BranchCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  RAVE_TRY_ASSIGN(const auto record, record_file(options.file));
  runtime::BranchOptions how;
  RAVE_TRY_ASSIGN(how.requests, requests_of(options));
  how.at_s = options.at_s;
  how.with_people = options.with_people;
  how.until_s = options.until_s;
  RunCommand run;
  run.output = options.output;
  run.replace = options.replace;
  run.quiet = options.quiet;
  run.no_picture = options.no_picture;
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(run, "branch"));
  RunStart& start = *opened;
  how.run = start.run_options(run, "branch");
  how.run.on_progress = [&](const report::Progress& progress) { start.console().show(progress); };
  const auto outcome = runtime::branch(record, *catalogue, how);
  start.console().clear();
  if (!outcome) {
    start.discard();
    return tl::unexpected(outcome.error());
  }
  const int code = report_outcome(run, outcome->run, start.path(), start.console());
  for (const std::string& refused : outcome->refused) {
    put_note(terminal_of(stderr).red("refused:"), refused);
  }
  if (outcome->differs_at) {
    put_note(terminal_of(stderr).red("differs:"),
             fmt::format("the repetition differs from the recording in step {}, before the branch; "
                         "`rave verify` tells more",
                         *outcome->differs_at));
    return kNotGood;
  }
  if (!options.quiet) {
    put(stdout, fmt::format("branched at {:g} s: {} steps before are equal to the recording\n",
                            options.at_s, outcome->compared));
  }
  return outcome->refused.empty() ? code : kNotGood;
}

Result<int> diff(const DiffCommand& options) {
  RAVE_TRY_ASSIGN(const auto first, record_file(options.first));
  RAVE_TRY_ASSIGN(const auto second, record_file(options.second));
  RAVE_TRY_ASSIGN(const auto found, runtime::diff_runs(first, second));
  const bool equal = !found.first && found.only_first.empty() && found.only_second.empty();
  if (options.quiet) return equal ? kGood : kNotGood;
  if (found.first) {
    put_first(*found.first);
  } else {
    put(stdout, fmt::format("equal: {} messages, to {:.3f} s\n", found.messages, found.common_s));
  }
  if (found.first) put(stdout, distances(found));
  for (const auto* const names : {&found.only_first, &found.only_second}) {
    if (names->empty()) continue;
    put(stdout,
        fmt::format("only in the {} run: {}\n", names == &found.only_first ? "first" : "second",
                    fmt::join(*names, ", ")));
  }
  return equal ? kGood : kNotGood;
}

}  // namespace rave::cli
