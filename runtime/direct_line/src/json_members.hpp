// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "rave/base/result.hpp"

namespace rave::direct_line {

/// Takes known members out of an object, so that finish() can refuse unknown ones. `object` must
/// outlive it. Errors of all functions: kParse.
class JsonMembers {
 public:
  explicit JsonMembers(const nlohmann::json& object) : object_(object) {}

  [[nodiscard]] bool has(const char* name) const { return object_.contains(name); }
  /// A finite number.
  [[nodiscard]] Result<double> number(const char* name);
  /// An integer from 0 to 2^53, up to which a double holds each integer.
  [[nodiscard]] Result<std::uint64_t> whole(const char* name);
  [[nodiscard]] Result<bool> flag(const char* name);
  /// A text of at most `most` bytes.
  [[nodiscard]] Result<std::string> text(const char* name, std::size_t most);
  [[nodiscard]] Result<const nlohmann::json*> any(const char* name);
  /// Succeeds if all members were taken.
  [[nodiscard]] Status finish() const;

  /// Parses an object; error kParse says that `what` was expected.
  [[nodiscard]] static Result<nlohmann::json> parse_object(std::string_view text, const char* what);

 private:
  const nlohmann::json& object_;
  std::size_t taken_ = 0;
};

}  // namespace rave::direct_line
