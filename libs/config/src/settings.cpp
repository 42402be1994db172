// SPDX-License-Identifier: Apache-2.0
#include "rave/config/settings.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/file.hpp"
#include "rave/base/named_path.hpp"
#include "rave/base/names.hpp"
#include "rave/base/number.hpp"
#include "rave/config/yaml.hpp"

namespace rave::config {
namespace {

/// Whether `key` is `path` or the names before one of its dots.
bool leads(std::string_view key, std::string_view path) noexcept {
  return path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.');
}

/// The names of the items of a list, of those that have one.
std::vector<std::string_view> names_in(const RawNode& list) {
  std::vector<std::string_view> names;
  for (const RawNode& item : list.children()) {
    if (const RawNode* const name = item.find("name")) names.push_back(name->scalar());
  }
  return names;
}

/// One `KEY=VALUE`.
class Setting {
 public:
  Setting(const std::string& words, const std::filesystem::path& folder, Diagnostics& diagnostics)
      : option_(std::make_shared<const std::string>("--set " + words)),
        folder_(folder),
        diagnostics_(diagnostics) {}

  void apply(RawNode& scenario, std::string_view words) {
    const std::size_t equals = words.find('=');
    if (equals == 0 || equals >= words.size() - 1) {
      return report("expected KEY=VALUE, such as `robots.prey.pose.x_m=1.5`");
    }
    auto value = parse(words.substr(equals + 1));
    if (!value) return;
    place(*value);
    RawNode* node = &scenario;
    std::string_view path = words.substr(0, equals);
    std::string_view above = "the scenario";
    while (!path.empty()) {
      const std::string_view name = first_of(*node, path);
      if (name.empty())
        return report(fmt::format("`{}` has an empty name", words.substr(0, equals)));
      node = node->is_sequence() ? item(*node, name) : entry(*node, name, above);
      if (node == nullptr) return;
      above = name;
      path.remove_prefix(name.size());
      if (path.empty()) break;
      path.remove_prefix(1);
      if (path.empty())
        return report(fmt::format("nothing follows the last dot of `{}`", words.substr(0, equals)));
    }
    *node = *std::move(value);
  }

 private:
  void report(std::string message) {
    diagnostics_.add(SourceLocation{*option_, 0, 0}, std::move(message));
  }

  std::optional<RawNode> parse(std::string_view text) {
    Diagnostics errors;
    // As the value of a key, so that it may be null.
    auto tree = parse_yaml(fmt::format("value: {}", text), *option_, errors);
    if (errors.ok() && tree->size() == 1) return tree->child(0);
    if (errors.ok()) errors.add({}, "expected one line");
    report(fmt::format("the value: {}", errors.errors()[0].message));
    return std::nullopt;
  }

  /// The place of a value is the option; a line and column in it would say nothing.
  void place(RawNode& node) const {
    node.set_where(option_, 0, 0);
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (node.is_mapping()) node.set_key_where(i, 0, 0);
      place(node.child(i));
    }
  }

  /// The first name of a path. A key with dots, as below `set` of a change, is one name.
  static std::string_view first_of(const RawNode& node, std::string_view path) {
    std::string_view longest = path.substr(0, path.find('.'));
    if (!node.is_mapping()) return longest;
    for (const std::string_view key : node.keys()) {
      if (key.size() > longest.size() && leads(key, path)) longest = path.substr(0, key.size());
    }
    return longest;
  }

  RawNode* item(RawNode& list, std::string_view name) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const RawNode* const own = list.child(i).find("name");
      if (own != nullptr && own->scalar() == name) return &list.child(i);
    }
    const auto index = number_of<std::size_t>(name);
    if (index && *index < list.size()) return &list.child(*index);
    const auto names = names_in(list);
    const std::string numbers = list.size() == 0
                                    ? "the list is empty"
                                    : fmt::format("expected a name or 0 to {}", list.size() - 1);
    report(fmt::format("there is no item `{}`; {}{}", name, numbers,
                       names.empty() ? "" : suggestion(name, names)));
    return nullptr;
  }

  RawNode* entry(RawNode& node, std::string_view name, std::string_view above) {
    if (node.is_null()) {
      node = RawNode::mapping();
      node.set_where(option_, 0, 0);
    }
    if (!node.is_mapping()) {
      report(fmt::format("`{}` has no keys: found {}", above, node.found_text()));
      return nullptr;
    }
    if (!bring_robot(node, name)) return nullptr;
    if (RawNode* const found = node.find(name)) return found;
    RawNode added;
    added.set_where(option_, 0, 0);
    node.append(std::string(name), std::move(added));
    return node.find(name);
  }

  /// For a key of a robot file: puts the content of the file into its entry.
  bool bring_robot(RawNode& entry, std::string_view name) {
    if (name != "robot" && name != "twin_robot") return true;
    const RawNode* const file = entry.find(name == "robot" ? "file" : "twin");
    const RawNode* const robot = entry.find(name);
    if (file == nullptr || !file->is_text() || (robot != nullptr && !robot->is_null())) return true;
    const auto path = named_path(folder_, file->scalar()).lexically_normal();
    const auto text = rave::read_file(path, kMaxFileBytes);
    if (!text) {
      diagnostics_.add(Error{text.error().code, text.error().message, file->where()});
      return false;
    }
    auto tree = parse_yaml(*text, path.string(), diagnostics_);
    if (!tree) return false;
    entry.set(name, *std::move(tree));
    return true;
  }

  std::shared_ptr<const std::string> option_;  // owned by all nodes of the value, too
  const std::filesystem::path& folder_;
  Diagnostics& diagnostics_;
};

}  // namespace

void apply_settings(RawNode& scenario, Settings settings, const std::filesystem::path& folder,
                    Diagnostics& diagnostics) {
  for (const std::string& words : settings) {
    Setting(words, folder, diagnostics).apply(scenario, words);
  }
}

}  // namespace rave::config
