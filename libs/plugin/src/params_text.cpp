// SPDX-License-Identifier: Apache-2.0
// Descriptions of parameters, as `rave describe` and the reference page show them.
#include "rave/plugin/params_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "rave/base/table.hpp"
#include "rave/base/text_width.hpp"
#include "rave/base/word_table.hpp"

namespace rave::plugin {
namespace {

constexpr WordTable<ParamType, 6> kTypes = {{
    {"bool", ParamType::kBool},
    {"integer", ParamType::kInteger},
    {"number", ParamType::kNumber},
    {"text", ParamType::kText},
    {"choice", ParamType::kChoice},
    {"list", ParamType::kNumbers},
}};

/// Larger limits mean "no limit": the largest double or integer.
bool is_unlimited(const ParamSpec& spec, double limit) noexcept {
  // 2^53: up to here doubles are whole numbers without gaps.
  const double far = spec.type == ParamType::kInteger ? 9007199254740992.0 : 1e300;
  return !(std::abs(limit) < far);
}

std::string yaml_number(double value) { return fmt::format("{}", value); }

std::string join_choices(const ParamSpec& spec) {
  std::string text;
  for (const char* choice : std::span(spec.choices, spec.choice_count)) {
    if (!text.empty()) text += ", ";
    text += choice;
  }
  return text;
}

/// Width of a page in characters.
constexpr std::size_t kPageWidth = 100;

/// The cells of one row, the order of both tables.
std::array<std::string, 6> cells_of(const ParamSpec& spec) {
  return {spec.name,          std::string(to_string(spec.type)),
          spec.unit,          range_text(spec),
          default_text(spec), spec.doc};
}

Table params_table(const DriverInfo& info) {
  // The widest columns before the sentence: with indent and gaps they fit a page.
  Table table;
  table.columns = {{.heading = "name", .widest = 28},    {.heading = "type", .widest = 8},
                   {.heading = "unit", .widest = 12},    {.heading = "range", .widest = 20},
                   {.heading = "default", .widest = 20}, {.heading = "meaning", .below = 28}};
  for (const ParamSpec& spec : info.param_specs()) {
    const auto cells = cells_of(spec);
    table.rows.emplace_back(cells.begin(), cells.end());
  }
  return table;
}

/// Escapes the characters that end a Markdown table cell or begin markup.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

/// `text` as code unless empty. Inside code only the bar must be escaped.
std::string as_code(std::string_view text) {
  if (text.empty()) return {};
  std::string out = "`";
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out + "`";
}

}  // namespace

std::string_view to_string(ParamType type) noexcept { return kTypes.of(type, "unknown"); }

std::string range_text(const ParamSpec& spec) {
  if (spec.type == ParamType::kText) return {};
  if (spec.type == ParamType::kBool) return "true, false";
  if (spec.type == ParamType::kChoice) return join_choices(spec);
  const bool no_min = is_unlimited(spec, spec.min);
  const bool no_max = is_unlimited(spec, spec.max);
  if (no_min && no_max) return {};
  if (no_max) return fmt::format("{} or more", yaml_number(spec.min));
  if (no_min) return fmt::format("at most {}", yaml_number(spec.max));
  return fmt::format("{} to {}", yaml_number(spec.min), yaml_number(spec.max));
}

std::string default_text(const ParamSpec& spec) {
  if (spec.required != 0) return "required";
  switch (spec.type) {
    case ParamType::kBool:
      return spec.default_number != 0 ? "true" : "false";
    case ParamType::kInteger:
    case ParamType::kNumber:
      return yaml_number(spec.default_number);
    case ParamType::kText:
      return *spec.default_text == '\0' ? "\"\"" : spec.default_text;
    case ParamType::kChoice:
      return spec.default_text;
    case ParamType::kNumbers:
      return "[]";
  }
  return {};
}

std::string describe(const Driver& driver, std::span<const DriverFact> facts) {
  const DriverInfo& info = driver.info;
  std::string page = fmt::format("{}\n", info.name);
  page += indented(info.summary, 2, kPageWidth);
  page += fmt::format("\n  kind     {}\n  version  {}\n  clock    {}\n", rave::to_string(info.kind),
                      info.version, rave::to_string(info.clock));
  for (const DriverFact& fact : facts) page += fmt::format("  {:<7}  {}\n", fact.key, fact.value);
  page += fmt::format("  file     {}\n", driver.file.string());
  if (*info.device != '\0') page += fmt::format("  device   part of a `{}`\n", info.device);
  page += "\n";
  if (info.param_count == 0) return page + "It has no parameters.\n";
  page += "Parameters\n";
  const TableOptions options{.width = kPageWidth, .look = TableLook::kSpaces, .indent = 2};
  return page + render_table(params_table(info), options);
}

std::string markdown(const Driver& driver, std::span<const DriverFact> facts) {
  const DriverInfo& info = driver.info;
  std::string more;
  for (const DriverFact& fact : facts) {
    std::string key = fact.key;
    if (!key.empty()) key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
    more += fmt::format(" {}: {}.", key, escaped(fact.value));
  }
  std::string section = fmt::format(
      "### `{}`\n\n{}\n\nKind: {}. Version: {}. Clock: {}.{} Plug-in: `{}`.{}\n\n", info.name,
      escaped(info.summary), rave::to_string(info.kind), info.version, rave::to_string(info.clock),
      more, driver.file.filename().string(),
      *info.device == '\0' ? std::string() : fmt::format(" Part of a device `{}`.", info.device));
  if (info.param_count == 0) return section + "It has no parameters.\n";
  section += "| name | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const ParamSpec& spec : info.param_specs()) {
    const auto [name, type, unit, range, value, doc] = cells_of(spec);
    section +=
        fmt::format("| {} | {} | {} | {} | {} | {} |\n", as_code(name), type, escaped(unit),
                    escaped(range), spec.required != 0 ? value : as_code(value), escaped(doc));
  }
  return section;
}

}  // namespace rave::plugin
