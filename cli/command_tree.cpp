// SPDX-License-Identifier: Apache-2.0
#include "command_tree.hpp"

#include <nlohmann/json.hpp>

namespace rave::cli {
namespace {

using Json = nlohmann::ordered_json;

Json option_json(const CLI::Option& option) {
  Json names = Json::array();
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  // A flag takes no value, whatever its type is called.
  const bool takes_value = option.get_items_expected_max() > 0;
  return {{"names", std::move(names)},
          {"positional", option.get_positional()},
          {"value", takes_value ? option.get_type_name() : ""},
          {"required", option.get_required()},
          {"repeatable", option.get_items_expected_max() > 1},
          {"text", option.get_description()}};
}

Json command_json(const CLI::App& app) {
  Json options = Json::array();
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) options.push_back(option_json(*option));
  }
  Json commands = Json::array();
  for (const CLI::App* below : app.get_subcommands(nullptr)) {
    commands.push_back(command_json(*below));
  }
  return {{"name", app.get_name()},
          {"text", app.get_description()},
          {"options", std::move(options)},
          {"footer", app.get_footer()},
          {"commands", std::move(commands)}};
}

}  // namespace

std::string command_tree(const CLI::App& root) { return command_json(root).dump(2) + "\n"; }

}  // namespace rave::cli
