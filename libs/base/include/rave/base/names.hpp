// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rave {

/// The number of single-character insertions, deletions, replacements and swaps of neighbours that
/// turn `a` into `b` (Damerau-Levenshtein, restricted form). Case counts.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance to `name`, or an empty view if none is near enough to
/// be a likely typing error. Ties go to the earlier candidate.
[[nodiscard]] std::string_view nearest_name(std::string_view name,
                                            std::span<const std::string_view> candidates);

/// `a, b and c`, for messages, or with another word before the last; `none` if empty.
[[nodiscard]] std::string join_names(std::span<const std::string_view> names,
                                     std::string_view last = "and");

/// "; did you mean `x`?" for the nearest candidate, or a list of all of them if none is near.
[[nodiscard]] std::string suggestion(std::string_view name,
                                     std::span<const std::string_view> candidates);

}  // namespace rave
