// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rave::codec {

/// Constraints and documentation of a field. Texts are views: pass literals. Limits on numbers
/// apply to each number of a list, map, array or optional.
struct FieldOptions {
  /// One sentence; becomes the comment of the written file and the schema's description.
  std::string_view doc = {};
  /// Smallest allowed number; not allowed itself if exclusive_min.
  std::optional<double> min = {};
  bool exclusive_min = false;
  /// Largest allowed number; not allowed itself if exclusive_max.
  std::optional<double> max = {};
  bool exclusive_max = false;
  /// SI symbol such as `m`, `s`, `rad`, `deg`, `m/s`; empty for a number without one.
  std::string_view unit = {};
  /// Length limits of a list or map (entries) or of a text (bytes).
  std::optional<std::size_t> min_items = {};
  std::optional<std::size_t> max_items = {};
};

/// The unit in words (`metres` for `m`); the symbol itself if it is not one of the usual ones.
[[nodiscard]] std::string_view unit_words(std::string_view unit) noexcept;

/// `noun (at least 0, in metres)`: what a number with these options is expected to be.
[[nodiscard]] std::string number_expectation(std::string_view noun, const FieldOptions& options);

/// Whether the number lies within min and max.
[[nodiscard]] bool in_range(double value, const FieldOptions& options) noexcept;

/// ` of at least 1 and at most 3 items`, ` of 2 items`, or empty if the length is free.
[[nodiscard]] std::string length_expectation(const FieldOptions& options, std::string_view item);

/// The noun for `count` things: `item`, `items`; `entry`, `entries`.
[[nodiscard]] std::string plural(std::string_view noun, std::size_t count);

/// Whether the length lies within min_items and max_items.
[[nodiscard]] bool in_length(std::size_t size, const FieldOptions& options) noexcept;

}  // namespace rave::codec
