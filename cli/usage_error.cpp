// SPDX-License-Identifier: Apache-2.0
#include "usage_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "error_text.hpp"
#include "rave/base/names.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {
namespace {

std::vector<std::string_view> subcommands_of(const CLI::App& root,
                                             std::vector<std::string>& names) {
  for (const CLI::App* app : root.get_subcommands(nullptr)) names.push_back(app->get_name());
  return {names.begin(), names.end()};
}

/// `rave report gap`
std::string full_name(const CLI::App& root) {
  std::string name = "rave";
  for (const CLI::App* app = &root; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  return name;
}

/// Where people look for what another command has.
std::string_view place_of(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kPlaces = {{
      {"list", "`rave ps` lists runs in progress, `rave run --help` scenarios"},
      {"runs", "`rave ps` lists runs in progress; the results of earlier ones are in `runs`"},
      {"scenario", "`rave run --help` lists the scenarios"},
      {"scenarios", "`rave run --help` lists the scenarios"},
  }};
  const auto* const found = std::ranges::find(kPlaces, word, &decltype(kPlaces)::value_type::first);
  return found == kPlaces.end() ? std::string_view() : found->second;
}

std::string unknown_option(const CLI::App& app, const std::string& extra) {
  const std::string word = extra.substr(0, extra.find('='));
  if (!word.starts_with("-")) return fmt::format("unexpected argument `{}`", word);
  if (word == "--no-gui")
    return "`--no-gui` belongs to `./run`; `rave run` has no page without --gui";
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    // Without a group: an option that help hides.
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  return fmt::format("there is no option `{}`{}", word, suggestion(word, views));
}

/// What had to be given and was not; empty if that is something else than an argument.
std::string missing_argument(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    if (option->get_positional()) {
      return fmt::format("missing {}: {}", option->get_type_name(), option->get_description());
    }
    return fmt::format("missing option {} {}: {}", option->get_name(), option->get_type_name(),
                       option->get_description());
  }
  std::vector<std::string> names;
  const auto views = subcommands_of(app, names);
  if (views.empty()) return {};
  return fmt::format("missing subcommand of `rave {}`: there are {}", app.get_name(),
                     join_names(views));
}

/// What an argument of several words expects; empty if there is none.
std::string several_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional() || option->get_expected_min() < 2) continue;
    return fmt::format("found {} word{}, expected {}: {}", option->count(),
                       option->count() == 1 ? "" : "s", option->get_type_name(),
                       option->get_description());
  }
  return {};
}

/// Messages of CLI11 about a value, in the words of this program.
std::string about_value(std::string message) {
  constexpr std::string_view kConvert = "Could not convert: ";
  constexpr std::string_view kNeeds = " required ";
  constexpr std::string_view kMissing = " missing";
  if (message.starts_with(kConvert)) {
    const std::size_t equal = message.find(" = ");
    if (equal == std::string::npos) return message;
    // Values of all other types are texts, which always convert.
    return fmt::format("{}: found `{}`, expected a number",
                       message.substr(kConvert.size(), equal - kConvert.size()),
                       message.substr(equal + 3));
  }
  const std::size_t needs = message.find(kNeeds);
  const std::size_t colon = message.find(": ");
  if (message.ends_with(kMissing) && needs != std::string::npos && colon < needs) {
    const std::size_t type = needs + kNeeds.size();
    return fmt::format("{}: found nothing, expected {}", message.substr(0, colon),
                       message.substr(type, message.size() - type - kMissing.size()));
  }
  return message;
}

}  // namespace

const CLI::App& chosen_app(const CLI::App& root) {
  const CLI::App* app = &root;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

// Looked at before CLI11, which says something vague about it.
std::optional<int> unknown_subcommand(const CLI::App& root, const std::string& word) {
  std::vector<std::string> names;
  const std::vector<std::string_view> views = subcommands_of(root, names);
  if (word.starts_with("-") || std::find(views.begin(), views.end(), word) != views.end()) {
    return std::nullopt;
  }
  const std::string_view place = place_of(word);
  const auto error = fail(ErrorCode::kInvalidArgument, "there is no subcommand `{}`{}", word,
                          place.empty() ? suggestion(word, views) : fmt::format("; {}", place));
  return complain(error.value());
}

int usage_error(const CLI::App& root, const CLI::ParseError& e) {
  const CLI::App& app = chosen_app(root);
  std::string message = about_value(e.what());
  const std::vector<std::string> extras = app.remaining();
  std::vector<std::string> below;
  const std::vector<std::string_view> subcommands = subcommands_of(app, below);
  if (!subcommands.empty() && !extras.empty() && !extras.front().starts_with("-")) {
    // Of `rave keys shwo`; the first word of all has been looked at before.
    message = fmt::format("there is no subcommand `{} {}`{}", app.get_name(), extras.front(),
                          suggestion(extras.front(), subcommands));
  } else if (dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr && !extras.empty()) {
    message = unknown_option(app, extras.front());
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) != nullptr) {
    const std::string several = several_words(app);
    if (!several.empty()) message = several;
  } else if (dynamic_cast<const CLI::RequiredError*>(&e) != nullptr) {
    const std::string missing = missing_argument(app);
    if (!missing.empty()) message = missing;
  }
  while (!message.empty() && message.back() == '\n') message.pop_back();
  const std::string name = full_name(root);
  complain({ErrorCode::kInvalidArgument, message, {}});
  put(stderr, fmt::format("for usage: `{} --help`\n", name));
  return kBadInput;
}

}  // namespace rave::cli
