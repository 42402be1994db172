// SPDX-License-Identifier: Apache-2.0
#include "rave/config/params.hpp"

#include <algorithm>

#include "known_keys.hpp"
#include "rave/config/codecs.hpp"

namespace rave::config {
namespace {

FieldOptions options_of(const FieldSpec& spec) {
  FieldOptions o;
  o.doc = spec.doc;
  o.unit = spec.unit;
  o.min = spec.min;
  o.exclusive_min = spec.exclusive_min;
  o.max = spec.max;
  o.exclusive_max = spec.exclusive_max;
  o.min_items = spec.min_items;
  o.max_items = spec.max_items;
  return o;
}

std::vector<std::string_view> views_of(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

template <class T>
ParamValue read_as(const ReadContext& context, const RawNode& node) {
  T value{};
  Codec<T>::read(context, node, value);
  return value;
}

ParamValue read_value(const ReadContext& context, const RawNode& node, const FieldSpec& spec) {
  switch (spec.type) {
    case ParamType::kBool:
      return read_as<bool>(context, node);
    case ParamType::kInt:
      return read_as<std::int64_t>(context, node);
    case ParamType::kDouble:
      return read_as<double>(context, node);
    case ParamType::kString:
      return read_as<std::string>(context, node);
    case ParamType::kDoubleList:
      return read_as<std::vector<double>>(context, node);
    case ParamType::kEnum:
      break;
  }
  const int row = detail::read_enum(context, node, views_of(spec.choices));
  return row < 0 ? std::string{} : spec.choices[static_cast<std::size_t>(row)];
}

std::string expectation_of(const FieldSpec& spec) {
  const FieldOptions options = options_of(spec);
  switch (spec.type) {
    case ParamType::kBool:
      return Codec<bool>::expectation(options);
    case ParamType::kInt:
      return Codec<std::int64_t>::expectation(options);
    case ParamType::kDouble:
      return Codec<double>::expectation(options);
    case ParamType::kString:
      return Codec<std::string>::expectation(options);
    case ParamType::kDoubleList:
      return Codec<std::vector<double>>::expectation(options);
    case ParamType::kEnum:
      break;
  }
  return detail::enum_expectation(views_of(spec.choices));
}

RawNode schema_of(const FieldSpec& spec) {
  const FieldOptions options = options_of(spec);
  switch (spec.type) {
    case ParamType::kBool:
      return Codec<bool>::schema(options);
    case ParamType::kInt:
      return Codec<std::int64_t>::schema(options);
    case ParamType::kDouble:
      return Codec<double>::schema(options);
    case ParamType::kString:
      return Codec<std::string>::schema(options);
    case ParamType::kDoubleList:
      return Codec<std::vector<double>>::schema(options);
    case ParamType::kEnum:
      break;
  }
  return detail::enum_schema(views_of(spec.choices));
}

RawNode node_of(const ParamValue& value) {
  return std::visit([](const auto& v) { return Codec<std::remove_cvref_t<decltype(v)>>::write(v); },
                    value);
}

bool has_type(const ParamValue& value, ParamType type) {
  switch (type) {
    case ParamType::kBool:
      return std::holds_alternative<bool>(value);
    case ParamType::kInt:
      return std::holds_alternative<std::int64_t>(value);
    case ParamType::kDouble:
      return std::holds_alternative<double>(value);
    case ParamType::kDoubleList:
      return std::holds_alternative<std::vector<double>>(value);
    case ParamType::kString:
    case ParamType::kEnum:
      break;
  }
  return std::holds_alternative<std::string>(value);
}

Status check_default(const FieldSpec& spec) {
  if (!spec.default_value) return {};
  if (!has_type(*spec.default_value, spec.type)) {
    return fail(ErrorCode::kInvalidArgument, "the default of `{}` is not of its type", spec.name);
  }
  Diagnostics diagnostics;
  const FieldOptions options = options_of(spec);
  const ReadContext context{diagnostics, options, fmt::format("the default of `{}`", spec.name)};
  (void)read_value(context, node_of(*spec.default_value), spec);
  if (diagnostics.ok()) return {};
  return fail(ErrorCode::kInvalidArgument, "{}", diagnostics.joined().message);
}

}  // namespace

const Param* ParamValues::find(std::string_view name) const noexcept {
  const auto found = std::find_if(params_.begin(), params_.end(),
                                  [name](const Param& p) { return p.name == name; });
  return found == params_.end() ? nullptr : &*found;
}

Status check_specs(std::span<const FieldSpec> specs) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const FieldSpec& spec = specs[i];
    if (spec.name.empty() || spec.name.size() > 200) {
      return fail(ErrorCode::kInvalidArgument, "parameter {} has no usable name", i + 1);
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (specs[j].name == spec.name) {
        return fail(ErrorCode::kInvalidArgument, "the parameter `{}` is declared twice", spec.name);
      }
    }
    if (spec.type == ParamType::kEnum && spec.choices.empty()) {
      return fail(ErrorCode::kInvalidArgument, "the parameter `{}` has no choices", spec.name);
    }
    RAVE_TRY(check_default(spec));
  }
  return {};
}

ParamValues read_params(const RawNode& node, std::span<const FieldSpec> specs,
                        std::string_view context, Diagnostics& diagnostics) {
  const std::string prefix = context.empty() ? std::string{} : fmt::format("{}: ", context);
  const auto report = [&](SourceLocation where, const std::string& message) {
    diagnostics.add(Error{ErrorCode::kParse, prefix + message, std::move(where)});
  };
  ParamValues values;
  if (!node.is_mapping() && !node.is_null()) {
    report(node.where(), fmt::format("found {}, expected a mapping", node.found_text()));
    return values;
  }
  std::vector<KnownKey> known;
  for (const FieldSpec& spec : specs) {
    known.push_back({spec.name, spec.unit});
    if (const RawNode* given = node.find(spec.name)) {
      const FieldOptions options = options_of(spec);
      Diagnostics found;
      const ReadContext read{found, options, fmt::format("`{}`", spec.name)};
      values.add({spec.name, read_value(read, *given, spec), given->where()});
      for (const Error& error : found.errors()) report(error.where, error.message);
    } else if (spec.default_value) {
      values.add({spec.name, *spec.default_value, {}});
    } else {
      report(node.where(),
             fmt::format("missing key `{}`: expected {}", spec.name, expectation_of(spec)));
    }
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    const bool is_known = std::any_of(known.begin(), known.end(),
                                      [&](const KnownKey& key) { return key.name == node.key(i); });
    if (!is_known) report(node.key_where(i), unknown_key_message(node.key(i), known));
  }
  return values;
}

Result<ParamValues> read_params(const RawNode& node, std::span<const FieldSpec> specs,
                                std::string_view context) {
  Diagnostics diagnostics;
  ParamValues values = read_params(node, specs, context, diagnostics);
  if (diagnostics.ok()) return values;
  diagnostics.sort();
  return tl::unexpected<Error>(diagnostics.joined());
}

RawNode write_params(const ParamValues& values, std::span<const FieldSpec> specs) {
  RawNode mapping = RawNode::mapping();
  for (const FieldSpec& spec : specs) {
    if (const Param* param = values.find(spec.name)) {
      mapping.append(spec.name, node_of(param->value), field_comment(spec.doc, spec.unit));
    }
  }
  return mapping;
}

RawNode params_schema(std::span<const FieldSpec> specs) {
  RawNode properties = RawNode::mapping();
  RawNode required = RawNode::sequence();
  for (const FieldSpec& spec : specs) {
    RawNode initial;
    if (spec.default_value) initial = node_of(*spec.default_value);
    properties.append(spec.name, annotated_schema(schema_of(spec), spec.doc, spec.unit,
                                                  spec.default_value ? &initial : nullptr));
    if (!spec.default_value) required.push_back(RawNode::text(spec.name));
  }
  return object_schema(std::move(properties), std::move(required));
}

}  // namespace rave::config
