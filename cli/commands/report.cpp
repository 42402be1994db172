// SPDX-License-Identifier: Apache-2.0
#include "commands/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/file.hpp"
#include "rave/base/table.hpp"
#include "rave/experiment/sweep.hpp"
#include "rave/experiment_report/page.hpp"
#include "rave/experiment_report/summary.hpp"

namespace rave::cli {
namespace {

std::vector<TableCell> row(std::string what, double metres, double degrees) {
  return {std::move(what), fmt::format("{:.4f} m", metres), fmt::format("{:.2f} deg", degrees)};
}

std::string table_of(const runtime::GapReport& gap) {
  Table table;
  table.title = fmt::format("{} against its simulated twin", gap.robot);
  table.columns = {{""}, {"distance", Align::kRight}, {"heading", Align::kRight}};
  for (const runtime::GapAt& at : gap.after) {
    table.rows.push_back(row(fmt::format("after {:g} s", at.after_s), at.metres, at.degrees));
  }
  table.rules_before.push_back(table.rows.size());
  table.rows.push_back(row("largest", gap.largest.metres, gap.largest_deg));
  table.rows.push_back(row("RMS", gap.rms_m, gap.rms_deg));
  const runtime::GapWindows& windows = gap.windows;
  if (windows.count > 0) {
    const std::string of = fmt::format("of {} windows of {:g} s", windows.count, windows.window_s);
    table.rules_before.push_back(table.rows.size());
    table.rows.push_back(row("median " + of, windows.median_m, windows.median_deg));
    table.rows.push_back(row("95 % " + of, windows.p95_m, windows.p95_deg));
  }
  TableOptions options;
  options.ansi = terminal_of(stdout).colour;
  return render_table(table, options);
}

}  // namespace

Result<int> report_experiment(const ReportCommand& options) {
  namespace fs = std::filesystem;
  const fs::path folder = options.folder;
  if (folder.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "report: expected the folder of a sweep, or `gap` with a recording");
  }
  RAVE_TRY_ASSIGN(auto plan, experiment::read_plan(folder));
  RAVE_TRY_ASSIGN(const auto rows, experiment::RunRows::read(folder));
  RAVE_TRY_ASSIGN(const auto analysis, experiment::analyse(std::move(plan), rows));
  const fs::path output = options.output.empty() ? folder : fs::path(options.output);
  RAVE_TRY(create_folder(output));
  RAVE_TRY(write_private_file_atomically(output / "report.html",
                                         experiment::report_page(analysis, RAVE_VERSION)));
  RAVE_TRY(write_private_file_atomically(output / "conditions.csv",
                                         experiment::condition_table(analysis)));
  if (!options.quiet) {
    const Terminal terminal = terminal_of(stdout);
    std::optional<std::size_t> width;
    if (terminal.is_terminal) width = terminal.width;
    put(stdout, experiment::report_summary(analysis, width, terminal.colour));
    put(stdout, fmt::format("{}: report.html, conditions.csv\n", output.string()));
  }
  return analysis.as_expected() ? kGood : kNotGood;
}

Result<int> report_gap(const GapCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  RAVE_TRY_ASSIGN(const auto record, record_file(options.file));
  RAVE_TRY_ASSIGN(const auto gap, runtime::measure_gap(record, *catalogue, options.gap));
  std::filesystem::path folder = options.output;
  if (folder.empty()) folder = record.parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  const std::string stem = "gap-" + gap.robot;
  const std::string json = runtime::gap_json(gap);
  RAVE_TRY(runtime::draw_gap(gap, folder, stem));
  RAVE_TRY(write_private_file_atomically(folder / (stem + ".json"), json));
  if (options.json) {
    put(stdout, json);
    return kGood;
  }
  put(stdout, table_of(gap));
  put(stdout,
      fmt::format(
          "twin: {}\ncommands: {}\npose: {}, {:.2f} s from {:.2f} s, {:.2f} m; known in {} of "
          "{} steps\n",
          gap.twin, gap.commands, gap.pose, gap.duration_s, gap.start_s, gap.driven_m,
          gap.points.size(), gap.steps));
  put(stdout, fmt::format("{}: {}.svg, {}.png, {}.json\n", folder.empty() ? "." : folder.string(),
                          stem, stem, stem));
  return kGood;
}

}  // namespace rave::cli
