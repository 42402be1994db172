// SPDX-License-Identifier: Apache-2.0
#include "commands/drivers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver_data.hpp"
#include "driver_json.hpp"
#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/names.hpp"
#include "rave/base/table.hpp"
#include "rave/config/yaml.hpp"
#include "rave/plugin/params_text.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave::cli {
namespace {

using Drivers = std::vector<const plugin::Driver*>;

Result<DriverKind> kind_of(const std::string& name) {
  std::vector<std::string_view> names;
  for (std::uint32_t k = 0; k < kDriverKindCount; ++k) {
    names.push_back(to_string(static_cast<DriverKind>(k)));
    // `virtual_sensor` and `virtual-sensor` mean what `virtual sensor` does and need no quotes.
    std::string plain = name;
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
    if (plain == names.back()) return static_cast<DriverKind>(k);
  }
  return fail(ErrorCode::kNotFound, "there is no kind of driver `{}`{}", name,
              suggestion(name, names));
}

std::string table_of(const Drivers& drivers, const Terminal& terminal) {
  Table table;
  // What a narrow terminal has no room for is in `rave describe`.
  table.columns = {{.heading = "kind"},
                   {.heading = "name"},
                   {.heading = "version", .weight = 1},
                   {.heading = "clock", .weight = 2},
                   {.heading = "summary", .may_wrap = true},
                   {.heading = "file", .weight = 3}};
  std::string_view last;
  for (const plugin::Driver* driver : drivers) {
    const DriverInfo& info = driver->info;
    const std::string_view kind = to_string(info.kind);
    if (!last.empty() && kind != last) table.rules_before.push_back(table.rows.size());
    table.rows.push_back({kind == last ? "" : std::string(kind), info.name, info.version,
                          std::string(to_string(info.clock)), info.summary,
                          driver->file.filename().string()});
    last = kind;
  }
  TableOptions options;
  if (terminal.is_terminal) options.width = terminal.width;
  options.ansi = terminal.colour;
  return render_table(table, options);
}

std::string rejected_text(const plugin::Catalogue& catalogue, const Terminal& terminal) {
  std::string text;
  for (const plugin::RejectedPlugin& plugin : catalogue.rejected()) {
    const std::string message = plugin.error.text();
    const std::string file = plugin.file.string();
    // The reasons name the files already.
    const bool named = message.find(file) != std::string::npos;
    text += fmt::format("{} {}{}{}\n", terminal.red("not usable:"), named ? "" : file,
                        named ? "" : ": ", message);
  }
  return text;
}

std::string_view noise_word(NoiseTerm term) {
  switch (term) {
    case NoiseTerm::kCoordinate:
    case NoiseTerm::kDistance:
      return "length";
    case NoiseTerm::kAngle:
      return "angle";
    case NoiseTerm::kVelocity:
      return "velocity";
    case NoiseTerm::kNone:
      break;
  }
  return "";
}

std::string_view shape_words(ReadingShape shape) {
  switch (shape) {
    case ReadingShape::kState:
      return "A sample has one record.";
    case ReadingShape::kSeries:
      return "A sample has a fixed number of records; `rave export` numbers their columns from 0.";
    case ReadingShape::kList:
      return "A sample has one record for each thing that is seen.";
  }
  return "";
}

/// What a record of each kind of readings consists of.
std::string readings_reference() {
  std::string text =
      "\n# Readings\n\nWhat the records of sensors consist of, from "
      "`libs/robot/src/reading_table.hpp`. "
      "Numbers are little endian.\nThe columns of `rave export` have the names of the fields; "
      "`stamp_ns` and `reserved` are no columns. *Noise* is the\nterm of `noise:` in the robot "
      "file "
      "that acts on a field, *filters* whether its filters do.\n";
  for (std::uint32_t kind = 1; record_size(ReadingKind{kind}) > 0; ++kind) {
    const ReadingType& type = reading_type(ReadingKind{kind});
    text += fmt::format(
        "\n### Readings of kind `{}`\n\n{} bytes, C++ type `{}`, number {} in recordings. {}\n\n"
        "| field | at byte | format | unit | noise | filters | variance "
        "|\n|---|---|---|---|---|---|---|\n",
        type.name, type.record_bytes, type.record, kind, shape_words(type.shape));
    for (const ReadingField& field : type.fields) {
      const auto code = [](std::string_view name) {
        return name.empty() ? std::string() : fmt::format("`{}`", name);
      };
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", code(field.name), field.offset,
                          to_string(field.format), field.unit, noise_word(field.noise),
                          field.filtered ? "yes" : "", code(field.variance));
    }
  }
  return text;
}

/// The generated reference: the same on every machine.
std::string reference_of(const Drivers& drivers) {
  std::string text =
      "# Drivers and programs\n\nThe output of `rave describe` for the drivers and programs that "
      "come with RAVE, and the [readings](#readings) of sensors.\nGenerated from the code by "
      "`tools/reference.sh`; edit the drivers "
      "instead.\n";
  std::string_view last;
  for (const plugin::Driver* driver : drivers) {
    const std::string_view kind = to_string(driver->info.kind);
    if (kind != last) text += fmt::format("\n# Kind: {}\n", kind);
    last = kind;
    text += "\n" + plugin::markdown(*driver, data_facts(driver->info));
  }
  return text + readings_reference();
}

std::string json_of(const Drivers& drivers, const plugin::Catalogue& catalogue) {
  codec::RawNode list = codec::RawNode::sequence();
  for (const plugin::Driver* driver : drivers) list.push_back(driver_json(*driver));
  codec::RawNode refused = codec::RawNode::sequence();
  for (const plugin::RejectedPlugin& plugin : catalogue.rejected()) {
    codec::RawNode entry = codec::RawNode::mapping();
    entry.append("file", codec::RawNode::text(plugin.file.string()));
    entry.append("reason", codec::RawNode::text(plugin.error.text()));
    refused.push_back(std::move(entry));
  }
  codec::RawNode root = codec::RawNode::mapping();
  root.append("drivers", std::move(list));
  root.append("rejected", std::move(refused));
  return codec::to_json(root);
}

}  // namespace

Result<int> drivers(const DriversCommand& options) {
  std::optional<DriverKind> wanted;
  if (!options.kind.empty()) {
    RAVE_TRY_ASSIGN(wanted, kind_of(options.kind));
  }
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  Drivers found = catalogue->all();
  std::erase_if(found, [&](const auto* driver) { return wanted && driver->info.kind != *wanted; });
  if (options.json) return put(stdout, json_of(found, *catalogue)), kGood;
  if (options.markdown) return put(stdout, reference_of(found)), kGood;
  put(stdout, found.empty() ? "no drivers\n" : table_of(found, terminal_of(stdout)));
  put(stderr, rejected_text(*catalogue, terminal_of(stderr)));
  return kGood;
}

}  // namespace rave::cli
