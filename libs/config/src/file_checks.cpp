// SPDX-License-Identifier: Apache-2.0
// Checks that files of several kinds share.
#include "file_checks.hpp"

#include <algorithm>

#include "rave/base/names.hpp"
#include "rave/math/decompose.hpp"

namespace rave::config {
namespace {

bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

bool is_colour(std::string_view text) noexcept {
  return text.size() == 7 && text[0] == '#' &&
         std::all_of(text.begin() + 1, text.end(), [](char c) {
           return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
         });
}

}  // namespace

bool is_variable_name(std::string_view name) noexcept {
  return !name.empty() && !is_digit(name[0]) && std::all_of(name.begin(), name.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  });
}

void check_name(std::string_view key, std::string_view name, CheckContext& check) {
  // Names become parts of topics, files and command lines, so they have no other characters.
  const bool usable = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
  });
  if (usable) return;
  check.error(key, "`{}`: found {}, expected letters, digits, `-` and `_`", key,
              RawNode::text(std::string(name)).found_text());
}

void check_colour(const std::optional<std::string>& colour, CheckContext& check) {
  if (!colour || is_colour(*colour)) return;
  check.error("colour", "`colour`: found {}, expected `#rrggbb` with hexadecimal digits",
              RawNode::text(*colour).found_text());
}

void check_heights(std::string_view key, const HeightRange& z_m, CheckContext& check) {
  if (z_m[0] < z_m[1]) return;
  check.error(key, "`{}`: found {} to {}, expected the first to be less than the second", key,
              z_m[0], z_m[1]);
}

void check_barcode(const std::optional<int>& barcode, const std::optional<HeightRange>& z_m,
                   CheckContext& check) {
  if (!z_m) return;
  check_heights("barcode_z_m", *z_m, check);
  if (!barcode) check.error("barcode_z_m", "`barcode_z_m` is given without `barcode`");
}

void check_outline(const Outline& outline, CheckContext& check) {
  const int count = int{outline.disc_radius_m.has_value()} + int{outline.box_m.has_value()} +
                    int{outline.polygon_m.has_value()};
  if (count != 1) {
    check.error("", "expected exactly one of `disc_radius_m`, `box_m` and `polygon_m`, found {}",
                count == 0   ? "none"
                : count == 2 ? "two"
                             : "three");
  }
  if (!outline.polygon_m) return;
  std::vector<Vec2> corners;
  for (const auto& corner : *outline.polygon_m) corners.push_back({corner[0], corner[1]});
  // Whether a polygon is usable is known only by decomposing it, as the world will.
  if (const auto pieces = decompose(corners); !pieces) {
    check.error("polygon_m", "`polygon_m`: {}", pieces.error().message);
  }
}

void check_params(const RawNode& params, CheckContext& check) {
  if (params.is_mapping() || params.is_null()) return;
  check.error("params", "`params`: found {}, expected a mapping", params.found_text());
}

std::string named_twice(std::string_view what, std::string_view name, const SourceLocation& first) {
  return fmt::format("two {}s are named `{}`; the first is at {}", what, name, first.text());
}

void check_reference(std::string_view key, std::string_view what, const Located<std::string>& name,
                     const std::vector<std::string_view>& names, CheckContext& check) {
  if (std::find(names.begin(), names.end(), *name) != names.end()) return;
  check.error_at(name.where, "`{}`: there is no {} `{}`{}", key, what, *name,
                 suggestion(*name, names));
}

}  // namespace rave::config
