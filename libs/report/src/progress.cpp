// SPDX-License-Identifier: Apache-2.0
// The progress line of a run, in the width of the terminal.
#include "rave/report/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rave/base/text_width.hpp"

namespace rave::report {
namespace {

constexpr std::size_t kBarWidth = 16;
constexpr std::string_view kGap = "  ";

/// Eighths of a column, so that slow progress is visible.
std::string bar_of(double fraction) {
  static constexpr std::array<std::string_view, 8> kEighths = {"",  "▏", "▎", "▍",
                                                               "▌", "▋", "▊", "▉"};
  const auto eighths = static_cast<std::size_t>(std::floor(fraction * 8.0 * kBarWidth));
  std::string bar = "│";
  for (std::size_t i = 0; i < eighths / 8; ++i) bar += "█";
  bar += kEighths[eighths % 8];
  const std::size_t used = eighths / 8 + (eighths % 8 > 0 ? 1 : 0);
  return bar + std::string(kBarWidth - used, ' ') + "│";
}

std::string pace_of(double pace) {
  if (!std::isfinite(pace) || pace < 0) return "–x";
  return pace < 9.95 ? fmt::format("{:.1f}x", pace) : fmt::format("{:.0f}x", pace);
}

std::string time_of(const Progress& progress) {
  if (!progress.end_s) return fmt::format("{:.1f} s", progress.sim_s);
  return fmt::format("{:.1f} of {:.1f} s", progress.sim_s, *progress.end_s);
}

/// The parts in order of the line; those with `priority` 0 are dropped last.
struct Part {
  std::string text;
  int priority;
};

std::string joined(const std::vector<Part>& parts, int lowest_priority) {
  std::string line;
  for (const Part& part : parts) {
    if (part.priority > lowest_priority || part.text.empty()) continue;
    if (!line.empty()) line += kGap;
    line += part.text;
  }
  return line;
}

}  // namespace

std::string format_progress(const Progress& progress, std::size_t width) {
  const double fraction =
      std::isfinite(progress.fraction) ? std::clamp(progress.fraction, 0.0, 1.0) : 0;
  std::vector<Part> parts;
  if (progress.end_s) {
    parts.push_back({bar_of(fraction), 2});
    parts.push_back({fmt::format("{:3.0f} %", std::floor(100 * fraction)), 0});
  }
  parts.push_back({time_of(progress), 0});
  parts.push_back({pace_of(progress.pace), 1});
  parts.push_back(
      {fmt::format("{} {}", progress.robots, progress.robots == 1 ? "robot" : "robots"), 3});

  // Parts are left out until the rest fits; the share and the time stay longest.
  int priority = 3;
  while (priority > 0 && columns_of(joined(parts, priority)) > width) --priority;
  std::string line = clip_to_columns(joined(parts, priority), width);
  const std::string text = without_controls(progress.text);
  const std::size_t used = columns_of(line);
  // Fewer columns would show little more than the ellipsis.
  constexpr std::size_t kLeastText = 6;
  if (priority == 3 && !text.empty() && used + kGap.size() + kLeastText <= width) {
    line += kGap;
    line += clip_to_columns(text, width - used - kGap.size());
  }
  // Padded, so that a shorter line covers the one before.
  return line + std::string(width - columns_of(line), ' ');
}

}  // namespace rave::report
