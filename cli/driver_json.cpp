// SPDX-License-Identifier: Apache-2.0
#include "driver_json.hpp"

#include <cmath>

#include "driver_data.hpp"
#include "rave/plugin/params_text.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave::cli {
namespace {

using codec::RawNode;

RawNode default_of(const ParamSpec& spec) {
  switch (spec.type) {
    case ParamType::kBool:
      return RawNode::boolean(spec.default_number != 0);
    case ParamType::kInteger:
      return RawNode::integer(static_cast<std::int64_t>(spec.default_number));
    case ParamType::kNumber:
      return RawNode::number(spec.default_number);
    case ParamType::kText:
    case ParamType::kChoice:
      return RawNode::text(spec.default_text);
    case ParamType::kNumbers:
      break;
  }
  return RawNode::sequence();
}

RawNode param_json(const ParamSpec& spec) {
  RawNode node = RawNode::mapping();
  node.append("name", RawNode::text(spec.name));
  node.append("type", RawNode::text(std::string(plugin::to_string(spec.type))));
  if (*spec.unit != '\0') node.append("unit", RawNode::text(spec.unit));
  const bool numeric = spec.type == ParamType::kInteger || spec.type == ParamType::kNumber ||
                       spec.type == ParamType::kNumbers;
  if (numeric && std::isfinite(spec.min)) node.append("min", RawNode::number(spec.min));
  if (numeric && std::isfinite(spec.max)) node.append("max", RawNode::number(spec.max));
  if (spec.type == ParamType::kChoice) {
    RawNode choices = RawNode::sequence();
    for (std::uint64_t i = 0; i < spec.choice_count; ++i) {
      choices.push_back(RawNode::text(spec.choices[i]));
    }
    node.append("choices", std::move(choices));
  }
  node.append("required", RawNode::boolean(spec.required != 0));
  if (spec.required == 0) node.append("default", default_of(spec));
  node.append("doc", RawNode::text(spec.doc));
  return node;
}

}  // namespace

RawNode driver_json(const plugin::Driver& driver) {
  const DriverInfo& info = driver.info;
  RawNode node = RawNode::mapping();
  node.append("kind", RawNode::text(std::string(to_string(info.kind))));
  node.append("name", RawNode::text(info.name));
  node.append("version", RawNode::text(info.version));
  node.append("clock", RawNode::text(std::string(to_string(info.clock))));
  for (const plugin::DriverFact& fact : data_facts(info)) {
    if (fact.key == "gives") {
      const auto kind = static_cast<ReadingKind>(info.data_kind);
      node.append("gives", RawNode::text(std::string(to_string(kind))));
      node.append("record_type", RawNode::text(std::string(reading_type(kind).record)));
    } else {
      node.append(fact.key, RawNode::text(fact.value));
    }
  }
  if (*info.device != '\0') node.append("device", RawNode::text(info.device));
  node.append("summary", RawNode::text(info.summary));
  node.append("file", RawNode::text(driver.file.string()));
  RawNode params = RawNode::sequence();
  for (const ParamSpec& spec : info.param_specs()) params.push_back(param_json(spec));
  node.append("params", std::move(params));
  return node;
}

}  // namespace rave::cli
