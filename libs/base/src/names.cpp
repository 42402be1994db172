// SPDX-License-Identifier: Apache-2.0
// Suggestions for names that do not exist.
#include "rave/base/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rave {
namespace {

std::vector<std::string_view> words_of(std::string_view name) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t end = std::min(name.find('_'), name.size());
    words.push_back(name.substr(0, end));
    if (end == name.size()) return words;
    name.remove_prefix(end + 1);
  }
}

bool is_unit(std::string_view word) {
  constexpr std::array<std::string_view, 13> kUnits = {
      "m", "mm", "cm", "s", "ms", "deg", "rad", "mps", "dps", "radps", "mps2", "hz", "kg"};
  return std::ranges::find(kUnits, word) != kUnits.end();
}

/// What people who know the thing and not its name write: the words in another order
/// (`max_range_m`), the last ones alone (`radius_m` for `disc_radius_m`), no unit, or another one.
bool is_variant(std::string_view name, std::string_view candidate) {
  std::vector<std::string_view> words = words_of(name);
  std::vector<std::string_view> others = words_of(candidate);
  if (words.size() > 1 && others.size() > words.size() &&
      std::equal(words.rbegin(), words.rend(), others.rbegin())) {
    return true;
  }
  if (words.size() < others.size() && is_unit(others.back()) && !is_unit(words.back())) {
    // The unit may have several words: `deg_per_s`.
    if (std::equal(words.begin(), words.end(), others.begin())) return true;
  }
  if (words.size() != others.size() || words.size() < 2) return false;
  if (is_unit(words.back()) && is_unit(others.back()) &&
      std::equal(words.begin(), words.end() - 1, others.begin())) {
    return true;
  }
  std::ranges::sort(words);
  std::ranges::sort(others);
  return words == others;
}

}  // namespace

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
    // Counts as one edit, however many letters it takes.
    if (!name.empty() && is_variant(name, candidate)) score = std::min(score, 1);
    if (score < best_score) {
      best_score = score;
      best = candidate;
    }
  }
  return best;
}

std::string join_names(std::span<const std::string_view> names, std::string_view last) {
  if (names.empty()) return "none";
  std::string text{names.front()};
  for (std::size_t i = 1; i < names.size(); ++i) {
    text += i + 1 == names.size() ? fmt::format(" {} {}", last, names[i])
                                  : fmt::format(", {}", names[i]);
  }
  return text;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> candidates) {
  const std::string_view near = nearest_name(name, candidates);
  if (!near.empty()) return fmt::format("; did you mean `{}`?", near);
  return fmt::format("; there are {}", join_names(candidates));
}

}  // namespace rave
