// SPDX-License-Identifier: Apache-2.0
#include "commands/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver_data.hpp"
#include "driver_json.hpp"
#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/names.hpp"
#include "rave/config/yaml.hpp"
#include "rave/plugin/params_text.hpp"

namespace rave::cli {
namespace {

using Drivers = std::vector<const plugin::Driver*>;

/// One for each kind that has the name, as a robot file would get it.
Drivers drivers_named(std::string_view name, plugin::Catalogue& catalogue) {
  Drivers found;
  for (std::uint32_t k = 0; k < kDriverKindCount; ++k) {
    const auto kind = static_cast<DriverKind>(k);
    if (auto driver = catalogue.find({&kind, 1}, name)) found.push_back(*driver);
  }
  return found;
}

/// Why a name describes nothing. A file that has it and cannot be used gives the reason.
tl::unexpected<Error> nothing_named(std::string_view name, plugin::Catalogue& catalogue) {
  std::vector<std::string_view> names;
  for (const plugin::Driver* driver : catalogue.all()) names.emplace_back(driver->info.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const std::string_view nearest = nearest_name(name, names);
  std::string message = fmt::format("there is no driver or program `{}`", name);
  message += nearest.empty()
                 ? fmt::format("; there are {}", join_names(names))
                 : fmt::format("; did you mean `{}`? (`rave drivers` lists all)", nearest);
  for (const plugin::RejectedPlugin& plugin : catalogue.rejected()) {
    message += "\n" + plugin.error.text();
  }
  return fail(ErrorCode::kNotFound, "{}", message);
}

}  // namespace

Result<int> describe(const DescribeCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  const Drivers found = drivers_named(options.driver, *catalogue);
  if (found.empty()) return nothing_named(options.driver, *catalogue);
  codec::RawNode list = codec::RawNode::sequence();
  std::string text;
  for (const plugin::Driver* driver : found) {
    if (!text.empty()) text += "\n";
    const auto facts = data_facts(driver->info);
    text += options.markdown ? plugin::markdown(*driver, facts) : plugin::describe(*driver, facts);
    list.push_back(driver_json(*driver));
  }
  put(stdout, options.json ? codec::to_json(list) : text);
  return kGood;
}

}  // namespace rave::cli
