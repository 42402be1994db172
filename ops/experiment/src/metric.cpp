// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/metric.hpp"

#include <string>
#include <vector>

#include "rave/base/names.hpp"
#include "rave/base/number.hpp"

namespace rave::experiment {
namespace {

using codec::RawNode;

const RawNode* item_of(const RawNode& list, std::string_view name) {
  for (const RawNode& item : list.children()) {
    for (const std::string_view key : {"name", "robot"}) {
      const RawNode* const own = item.find(key);
      if (own != nullptr && own->scalar() == name) return &item;
    }
  }
  const auto index = number_of<std::size_t>(name);
  return index && *index < list.size() ? &list.child(*index) : nullptr;
}

/// What could stand in the place of `name`, for messages.
std::vector<std::string_view> names_below(const RawNode& node) {
  if (node.is_mapping()) return node.keys();
  std::vector<std::string_view> names;
  for (const RawNode& item : node.children()) {
    if (const RawNode* const own = item.find("name")) names.push_back(own->scalar());
  }
  return names;
}

}  // namespace

Result<std::optional<double>> number_at(const RawNode& result, std::string_view path) {
  const RawNode* node = &result;
  for (std::string_view rest = path; !rest.empty();) {
    const std::size_t dot = rest.find('.');
    const std::string_view name = rest.substr(0, dot);
    rest.remove_prefix(dot == std::string_view::npos ? rest.size() : dot + 1);
    // What is null as a whole has no numbers either.
    if (node->is_null()) return std::optional<double>();
    const RawNode* const below = node->is_sequence() ? item_of(*node, name) : node->find(name);
    if (below == nullptr) {
      return fail(ErrorCode::kNotFound, "result.json has no `{}` of `{}`{}", name, path,
                  suggestion(name, names_below(*node)));
    }
    node = below;
  }
  if (node->is_null()) return std::optional<double>();
  if (const auto truth = node->as_bool()) return std::optional<double>(*truth ? 1 : 0);
  if (const auto number = node->as_double()) return std::optional<double>(*number);
  return fail(ErrorCode::kInvalidArgument, "`{}` of result.json: found {}, expected a number", path,
              node->found_text());
}

Result<std::optional<double>> value_of(const config::MetricFile& metric, const RawNode& result) {
  auto value = number_at(result, *metric.value);
  if (value || value.error().code != ErrorCode::kNotFound || !metric.absent) return value;
  return std::optional<double>(*metric.absent);
}

}  // namespace rave::experiment
