// SPDX-License-Identifier: Apache-2.0
// Parameters of drivers and programs: read by what the plug-in declares, with the same codecs as
// the files.
#include "rave/config/params.hpp"

#include <algorithm>
#include <type_traits>

#include "rave/config/described.hpp"

namespace rave::config {
namespace {

std::vector<std::string_view> views_of(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

/// Calls `f` with the C++ type of a parameter; an enum is a std::string.
template <class F>
auto with_type(ParamType type, F&& f) {
  switch (type) {
    case ParamType::kBool:
      return f(std::type_identity<bool>());
    case ParamType::kInt:
      return f(std::type_identity<std::int64_t>());
    case ParamType::kDouble:
      return f(std::type_identity<double>());
    case ParamType::kDoubleList:
      return f(std::type_identity<std::vector<double>>());
    case ParamType::kString:
    case ParamType::kEnum:
      break;
  }
  return f(std::type_identity<std::string>());
}

ParamValue read_value(const ReadContext& context, const RawNode& node, const FieldSpec& spec) {
  if (spec.type == ParamType::kEnum) {
    const int row = codec::detail::read_enum(context, node, views_of(spec.choices));
    return row < 0 ? std::string{} : spec.choices[static_cast<std::size_t>(row)];
  }
  return with_type(spec.type, [&]<class T>(std::type_identity<T> /*type*/) -> ParamValue {
    T value{};
    Codec<T>::read(context, node, value);
    return value;
  });
}

std::string expectation_of(const FieldSpec& spec) {
  if (spec.type == ParamType::kEnum) return codec::detail::enum_expectation(views_of(spec.choices));
  return with_type(spec.type, [&]<class T>(std::type_identity<T> /*type*/) -> std::string {
    return Codec<T>::expectation(spec);
  });
}

}  // namespace

const Param* ParamValues::find(std::string_view name) const noexcept {
  const auto found = std::find_if(params_.begin(), params_.end(),
                                  [name](const Param& p) { return p.name == name; });
  return found == params_.end() ? nullptr : &*found;
}

ParamValues read_params(const RawNode& node, std::span<const FieldSpec> specs,
                        std::string_view context, Diagnostics& diagnostics) {
  const std::string prefix = context.empty() ? std::string{} : fmt::format("{}: ", context);
  const auto report = [&](SourceLocation where, const std::string& message) {
    diagnostics.add(std::move(where), prefix + message);
  };
  ParamValues values;
  if (!node.is_mapping() && !node.is_null()) {
    report(node.where(), fmt::format("found {}, expected a mapping", node.found_text()));
    return values;
  }
  std::vector<codec::detail::KnownKey> known;
  for (const FieldSpec& spec : specs) {
    known.push_back({spec.name, spec.unit});
    if (const RawNode* given = node.find(spec.name)) {
      // Collected apart, because the name of the plug-in is put before each error.
      Diagnostics found;
      const ReadContext read{found, spec, fmt::format("`{}`", spec.name)};
      values.add({spec.name, read_value(read, *given, spec), given->where()});
      for (const Error& error : found.errors()) report(error.where, error.message);
    } else if (spec.default_value) {
      values.add({spec.name, *spec.default_value, {}});
    } else {
      report(node.where(),
             fmt::format("missing key `{}`: expected {}", spec.name, expectation_of(spec)));
    }
  }
  codec::detail::report_unknown_keys(node, known, prefix, diagnostics);
  return values;
}

Result<ParamValues> read_params(const RawNode& node, std::span<const FieldSpec> specs,
                                std::string_view context) {
  Diagnostics diagnostics;
  ParamValues values = read_params(node, specs, context, diagnostics);
  return diagnostics.value_or_errors(std::move(values));
}

}  // namespace rave::config
