// SPDX-License-Identifier: Apache-2.0
// Suggestions for names that do not exist.
#include "rave/base/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rave {

// Insertions, deletions, changes and swaps of neighbours count one each (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the dynamic programming table suffice: a swap looks two rows back.
  std::vector<int> before(b.size() + 1);
  std::vector<int> last(b.size() + 1);
  std::vector<int> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
  std::string_view best;
  // A third of the letters may be wrong; beyond that a suggestion would be a guess.
  int best_score = static_cast<int>(std::max<std::size_t>(2, name.size() / 3)) + 1;
  for (const std::string_view candidate : candidates) {
    int score = edit_distance(name, candidate);
    // A name without its unit, `range` for `range_m`, counts as one edit, whatever the unit's
    // length.
    if (!name.empty() && candidate.size() > name.size() && candidate.starts_with(name) &&
        candidate[name.size()] == '_') {
      score = std::min(score, 1);
    }
    if (score < best_score) {
      best_score = score;
      best = candidate;
    }
  }
  return best;
}

std::string join_names(std::span<const std::string_view> names) {
  if (names.empty()) return "none";
  std::string text{names.front()};
  for (std::size_t i = 1; i < names.size(); ++i) {
    text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> candidates) {
  const std::string_view near = nearest_name(name, candidates);
  if (!near.empty()) return fmt::format("; did you mean `{}`?", near);
  return fmt::format("; there are {}", join_names(candidates));
}

}  // namespace rave
