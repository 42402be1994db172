// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/described.hpp"

namespace rave::config {

/// The types of parameters that are only known at run time, such as those of a plug-in.
enum class ParamType : std::uint8_t { kBool, kInt, kDouble, kString, kEnum, kDoubleList };

/// The value of a parameter; an enum is stored as the name of its choice.
using ParamValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// The description of one parameter at run time. Its texts must outlive it. Limits apply to each
/// number of a list, `min_items` and `max_items` to the length of a list or the bytes of a string.
struct FieldSpec : FieldOptions {
  std::string name{};
  ParamType type = ParamType::kDouble;
  std::vector<std::string> choices{};         ///< For an enum.
  std::optional<ParamValue> default_value{};  ///< Empty: the parameter is required.
};

/// One parameter with its value.
struct Param {
  std::string name;
  ParamValue value;
  SourceLocation where = {};  ///< The place of the value; without a file for a default.
  friend bool operator==(const Param& a, const Param& b) {
    return a.name == b.name && a.value == b.value;
  }
};

/// All parameters of one plug-in instance, in the order of the specs.
class ParamValues {
 public:
  void add(Param param) { params_.push_back(std::move(param)); }
  [[nodiscard]] std::span<const Param> all() const noexcept { return params_; }
  [[nodiscard]] std::size_t size() const noexcept { return params_.size(); }
  /// The parameter of this name; nullptr if there is none.
  [[nodiscard]] const Param* find(std::string_view name) const noexcept;
  /// The value of this name as T; nullptr if there is none of this name and type.
  template <class T>
  [[nodiscard]] const T* get(std::string_view name) const noexcept {
    const Param* param = find(name);
    return param ? std::get_if<T>(&param->value) : nullptr;
  }
  friend bool operator==(const ParamValues&, const ParamValues&) = default;

 private:
  std::vector<Param> params_;
};

/// Reads parameters from a mapping (or null: none given) and adds the defaults. Unknown names and
/// wrong types are errors. `context` begins each message, for example "driver `virtual_laser`".
/// Errors are added to the diagnostics; the values are complete only if none was added.
[[nodiscard]] ParamValues read_params(const RawNode& node, std::span<const FieldSpec> specs,
                                      std::string_view context, Diagnostics& diagnostics);
/// Like read_params(), with all errors joined into one.
[[nodiscard]] Result<ParamValues> read_params(const RawNode& node, std::span<const FieldSpec> specs,
                                              std::string_view context);

}  // namespace rave::config
