// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "rave/base/table.hpp"
#include "rave/base/text_width.hpp"
#include "short_text.hpp"

namespace rave::watch {
namespace {

constexpr std::size_t kLongestName = 24;
/// Below this share of the requested rate a value needs attention.
constexpr double kGoodShare = 0.9;
/// Above this share of missed deadlines, too: by default such a run is not complete.
constexpr double kMostMissed_pct = 1;

Tone tone_of(Standing standing) {
  constexpr Tone kTones[] = {Tone::kCare, Tone::kGood, Tone::kCare, Tone::kBad, Tone::kBad};
  return kTones[static_cast<std::size_t>(standing)];
}

Tone tone_of(Phase phase) {
  if (phase == Phase::kFailed) return Tone::kBad;
  return phase == Phase::kRunning || phase == Phase::kEnded ? Tone::kGood : Tone::kCare;
}

template <class Value, class Text>
TableCell cell(const std::optional<Value>& value, Text text) {
  return {value ? text(*value) : std::string()};
}

TableCell rate_cell(const std::optional<double>& rate, const std::optional<double>& asked) {
  if (!rate) return {};
  if (!asked) return {number_text(*rate)};
  return {fmt::format("{}/{}", number_text(*rate), number_text(*asked)),
          *rate < kGoodShare * *asked ? Tone::kCare : Tone::kPlain};
}

TableCell count_cell(const std::optional<std::uint64_t>& count) {
  if (!count) return {};
  return {fmt::format("{}", *count), *count > 0 ? Tone::kCare : Tone::kPlain};
}

/// Share of the deadlines that were missed, and what took the time.
TableCell late_cell(const HostView& host) {
  if (!host.missed_pct) return {};
  std::string text = fmt::format("{:.{}f}%", *host.missed_pct, *host.missed_pct < 10 ? 1 : 0);
  if (!host.late_phase.empty()) text += " " + fitted(host.late_phase, kLongestName);
  return {std::move(text), *host.missed_pct > kMostMissed_pct ? Tone::kCare : Tone::kPlain};
}

std::string robots_text(const HostView& host) {
  if (!host.robots) return {};
  if (!host.real_robots) return fmt::format("{}", *host.robots);
  return fmt::format("{}+{}", *host.real_robots,
                     *host.robots - std::min(*host.robots, *host.real_robots));
}

std::vector<TableCell> row_of(const HostView& host) {
  const auto plain = [](auto value) { return fmt::format("{}", value); };
  const bool told = host.offset_s && host.bound_s;
  return {
      {fitted(host.manager ? "manager" : host.name, kLongestName)},
      {fitted(host.machine, kLongestName)},
      {std::string(to_string(host.standing)), tone_of(host.standing)},
      {robots_text(host)},
      cell(host.step, plain),
      rate_cell(host.rate_hz, host.asked_rate_hz),
      cell(host.age_s, time_text),
      cell(host.delay_s, time_text),
      cell(host.round_trip_s, time_text),
      {told ? offset_text(*host.offset_s, *host.bound_s) : std::string()},
      count_cell(host.lost),
      count_cell(host.refused),
      late_cell(host),
      cell(host.cores, [](double cores) { return fmt::format("{:.0f}%", 100 * cores); }),
      cell(host.memory_mb, [](double mb) { return fmt::format("{:.0f} MB", mb); }),
      cell(host.process, plain),
  };
}

/// The column of least weight is left out first.
TableColumn column(const char* heading, Align align, int weight) {
  return {.heading = heading, .align = align, .weight = weight};
}

Table hosts_table(const RunView& view) {
  Table table;
  table.columns = {column("HOST", Align::kLeft, 100),   column("MACHINE", Align::kLeft, 40),
                   column("STATE", Align::kLeft, 90),   column("REAL+SIM", Align::kRight, 70),
                   column("STEP", Align::kRight, 50),   column("RATE /s", Align::kRight, 80),
                   column("AGE", Align::kRight, 75),    column("DELAY", Align::kRight, 45),
                   column("TRIP", Align::kRight, 30),   column("CLOCK", Align::kRight, 55),
                   column("LOST", Align::kRight, 65),   column("REFUSED", Align::kRight, 25),
                   column("LATE", Align::kRight, 85),   column("CPU", Align::kRight, 60),
                   column("MEMORY", Align::kRight, 35), column("PID", Align::kRight, 20)};
  for (const HostView& host : view.hosts) table.rows.push_back(row_of(host));
  return table;
}

/// Empty for a robot without a reported pose, as in lock-step.
TableCell state_cell(const RobotView& robot) {
  if (!robot.age_s && !robot.stale) return {};
  return {robot.stale ? "stale" : "heard", robot.stale ? Tone::kBad : Tone::kGood};
}

std::vector<TableCell> row_of(const RobotView& robot) {
  const auto place = [](double value) { return fmt::format("{:.2f}", value); };
  const std::string name = robot.name.empty() ? fmt::format("#{}", robot.number) : robot.name;
  const std::string kind = !robot.simulated ? "" : (*robot.simulated ? "simulated" : "real");
  return {{fitted(name, kLongestName)},
          {fitted(robot.team, kLongestName)},
          {fitted(robot.host, kLongestName)},
          {fitted(robot.driver, kLongestName)},
          {kind},
          state_cell(robot),
          cell(robot.age_s, time_text),
          rate_cell(robot.rate_hz, robot.asked_rate_hz),
          cell(robot.x_m, place),
          cell(robot.y_m, place)};
}

Table robots_table(const RunView& view) {
  Table table;
  table.columns = {column("ROBOT", Align::kLeft, 100),  column("TEAM", Align::kLeft, 35),
                   column("ON HOST", Align::kLeft, 60), column("DRIVER", Align::kLeft, 55),
                   column("KIND", Align::kLeft, 50),    column("STATE", Align::kLeft, 90),
                   column("AGE", Align::kRight, 80),    column("RATE /s", Align::kRight, 70),
                   column("X m", Align::kRight, 45),    column("Y m", Align::kRight, 40)};
  for (const RobotView& robot : view.robots) table.rows.push_back(row_of(robot));
  return table;
}

std::string timing_text(Timing timing) {
  constexpr const char* kTexts[] = {"", "in lock-step", "in real time", "one process"};
  return kTexts[static_cast<std::size_t>(timing)];
}

/// The first line: parts that are left out from the end if it is too narrow.
std::string title_of(const RunView& view, const PageOptions& options) {
  std::vector<TableCell> parts;
  parts.emplace_back(view.scenario.empty() ? std::string("run") : view.scenario);
  parts.emplace_back(std::string(to_string(view.phase)), tone_of(view.phase));
  if (view.time_s && view.duration_s) {
    parts.emplace_back(fmt::format("{:.2f} of {:.2f} s", *view.time_s, *view.duration_s));
  } else if (view.time_s) {
    parts.emplace_back(fmt::format("{:.2f} s", *view.time_s));
  }
  if (view.speed) parts.emplace_back(fmt::format("{}x", number_text(*view.speed)));
  parts.emplace_back(timing_text(view.timing));
  if (view.step && view.steps && view.timing != Timing::kRealTime) {
    parts.emplace_back(fmt::format("step {} of {}", *view.step, *view.steps));
  }
  parts.emplace_back("run " + view.run.substr(0, view.timing == Timing::kAlone ? 40 : 8));
  std::string line;
  std::size_t used = 0;
  for (const TableCell& part : parts) {
    if (part.text.empty()) continue;
    const std::string text = fitted(part.text, options.width);
    const std::size_t more = columns_of(text) + (used == 0 ? 0 : 3);
    if (used + more > options.width) break;
    line += (used == 0 ? "" : "   ") + toned(text, part.tone, options.colour);
    used += more;
  }
  return line;
}

std::string legend(const PageOptions& options) {
  struct Entry {
    Standing standing;
    std::string_view meaning;
  };
  constexpr Entry kEntries[] = {{Standing::kHere, ""},
                                {Standing::kWaiting, " not in the run yet"},
                                {Standing::kLate, " silent"},
                                {Standing::kGone, ""},
                                {Standing::kDropped, " gone for good"}};
  std::string line;
  std::size_t used = 0;
  for (const Entry& entry : kEntries) {
    const std::string word(to_string(entry.standing));
    const std::size_t more = word.size() + entry.meaning.size() + (used == 0 ? 0 : 3);
    if (used + more > options.width) break;
    line += (used == 0 ? "" : "   ") + toned(word, tone_of(entry.standing), options.colour) +
            toned(std::string(entry.meaning), Tone::kFaint, options.colour);
    used += more;
  }
  const std::size_t keys = columns_of(options.keys);
  if (keys > 0 && used + 3 + keys <= options.width) {
    line += std::string(options.width - used - keys, ' ') +
            toned(options.keys, Tone::kFaint, options.colour);
  }
  return line;
}

}  // namespace

std::vector<std::string> render_page(const RunView& view, const PageOptions& options) {
  // Height 0: no terminal, so nothing is cut.
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> lines = {title_of(view, options)};
  if (!view.text.empty()) lines.push_back(fitted(view.text, options.width));
  lines.emplace_back();
  // Behind the tables an empty line and the legend.
  constexpr std::size_t kBelow = 2;
  const auto left = [&](std::size_t headings) {
    const std::size_t used = lines.size() + headings + kBelow;
    return options.height == 0 ? kAll : options.height - std::min(options.height, used);
  };
  const auto add = [&](const Table& table, std::size_t most_rows) {
    const TableOptions how{.width = options.width,
                           .ansi = options.colour,
                           .look = TableLook::kSpaces,
                           .most_rows = most_rows};
    std::ranges::move(table_lines(table, how), std::back_inserter(lines));
  };
  const bool robots = !view.robots.empty();
  // With both tables the hosts get at most half of the page.
  const std::size_t rows = left(1);
  add(hosts_table(view), robots && rows != kAll ? std::max<std::size_t>(1, rows / 2) : rows);
  if (robots) {
    lines.emplace_back();
    if (left(1) > 0) add(robots_table(view), left(1));
  }
  lines.emplace_back();
  lines.push_back(legend(options));
  if (options.height > 0 && lines.size() > options.height) lines.resize(options.height);
  return lines;
}

}  // namespace rave::watch
