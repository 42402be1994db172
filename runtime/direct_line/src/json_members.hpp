// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "rave/base/result.hpp"

namespace rave::direct_line {

/// Takes members out of an object, so that what nobody knows is left over and refused. `object`
/// outlives it. Errors of all: kParse.
class JsonMembers {
 public:
  explicit JsonMembers(const nlohmann::json& object) : object_(object) {}

  [[nodiscard]] bool has(const char* name) const { return object_.contains(name); }
  /// Finite.
  [[nodiscard]] Result<double> number(const char* name);
  /// From 0 to 2^53.
  [[nodiscard]] Result<std::uint64_t> whole(const char* name);
  [[nodiscard]] Result<bool> flag(const char* name);
  /// At most so many bytes.
  [[nodiscard]] Result<std::string> text(const char* name, std::size_t most);
  [[nodiscard]] Result<const nlohmann::json*> any(const char* name);
  /// Whether all were taken.
  [[nodiscard]] Status finish() const;

  /// An object, or error kParse that says `what` was expected.
  [[nodiscard]] static Result<nlohmann::json> parse_object(std::string_view text, const char* what);

 private:
  const nlohmann::json& object_;
  std::size_t taken_ = 0;
};

}  // namespace rave::direct_line
