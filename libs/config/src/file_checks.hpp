// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/config/described.hpp"
#include "rave/config/shape_file.hpp"

// Checks common to robot, world and scenario files. Each reports to the context.
namespace rave::config {

[[nodiscard]] bool is_variable_name(std::string_view name) noexcept;

/// Letters, digits, `-` and `_`, not empty: usable in file and topic names.
void check_name(std::string_view key, std::string_view name, CheckContext& check);
void check_colour(const std::optional<std::string>& colour, CheckContext& check);
void check_heights(std::string_view key, const HeightRange& z_m, CheckContext& check);
void check_barcode(const std::optional<int>& barcode, const std::optional<HeightRange>& z_m,
                   CheckContext& check);
/// Checks that exactly one member is set, and that a polygon is simple.
void check_outline(const Outline& outline, CheckContext& check);
/// Checks the parameters of a driver: a mapping or null.
void check_params(const RawNode& params, CheckContext& check);

/// The message for the second of two items with one name, with the place of the first.
[[nodiscard]] std::string named_twice(std::string_view what, std::string_view name,
                                      const SourceLocation& first);

/// Reports items with the `name` of an earlier one.
template <class Items>
void check_unique(std::string_view what, const Items& items, CheckContext& check) {
  std::map<std::string_view, const SourceLocation*> seen;
  for (const auto& item : items) {
    const auto [first, is_new] = seen.emplace(*item.name, &item.name.where);
    if (!is_new) {
      check.error_at(item.name.where, "{}", named_twice(what, *item.name, *first->second));
    }
  }
}

/// The names of items, for messages; valid while the items are.
template <class Items>
[[nodiscard]] std::vector<std::string_view> names_of(const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(*item.name);
  return names;
}

/// Reports a reference to an item that does not exist.
void check_reference(std::string_view key, std::string_view what, const Located<std::string>& name,
                     const std::vector<std::string_view>& names, CheckContext& check);

}  // namespace rave::config
