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

/// The generated reference: the same on every machine.
std::string reference_of(const Drivers& drivers) {
  std::string text =
      "# Drivers and programs\n\nThe output of `rave describe` for the drivers and programs that "
      "come with RAVE.\nGenerated from the code by `tools/reference.sh`; edit the drivers "
      "instead.\n";
  std::string_view last;
  for (const plugin::Driver* driver : drivers) {
    const std::string_view kind = to_string(driver->info.kind);
    if (kind != last) text += fmt::format("\n# Kind: {}\n", kind);
    last = kind;
    text += "\n" + plugin::markdown(*driver, data_facts(driver->info));
  }
  return text;
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
