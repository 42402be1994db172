// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "rave/base/result.hpp"

namespace rave::gui_server {

using PageJson = nlohmann::json;

/// Takes members out of an object, so that unknown members are left over and refused.
class Members {
 public:
  explicit Members(const PageJson& object) : object_(object) {}

  Result<bool> flag(const char* name) {
    RAVE_TRY_ASSIGN(const PageJson* const value, find(name));
    if (!value->is_boolean()) return wrong(name, "true or false");
    return value->get<bool>();
  }
  Result<double> number(const char* name) {
    RAVE_TRY_ASSIGN(const PageJson* const value, find(name));
    if (!value->is_number() || !std::isfinite(value->get<double>())) {
      return wrong(name, "a finite number");
    }
    return value->get<double>();
  }
  Result<std::uint32_t> index(const char* name) {
    RAVE_TRY_ASSIGN(const PageJson* const value, find(name));
    return index_of(*value, name);
  }
  Result<std::string> word(const char* name) {
    RAVE_TRY_ASSIGN(const PageJson* const value, find(name));
    if (!value->is_string()) return wrong(name, "a string");
    return value->get<std::string>();
  }
  Result<const PageJson*> array(const char* name, std::size_t most) {
    RAVE_TRY_ASSIGN(const PageJson* const value, find(name));
    if (!value->is_array() || value->size() > most) {
      return fail(ErrorCode::kParse, "`{}`: expected an array of at most {}", name, most);
    }
    return value;
  }
  /// A string of limited length in bytes, without control characters but line breaks if `lines`.
  Result<std::string> text(const char* name, std::size_t most, bool lines = false) {
    RAVE_TRY_ASSIGN(std::string text, word(name));
    const bool plain = std::none_of(text.begin(), text.end(), [lines](char c) {
      return (static_cast<unsigned char>(c) < 0x20 && !(lines && c == '\n')) || c == 0x7f;
    });
    if (text.size() > most || !plain) {
      return fail(ErrorCode::kParse, "`{}`: expected at most {} bytes of text", name, most);
    }
    return text;
  }
  Result<const PageJson*> any(const char* name) { return find(name); }
  [[nodiscard]] bool has(const char* name) const { return object_.contains(name); }
  [[nodiscard]] Status finish() const {
    if (object_.size() != taken_) return fail(ErrorCode::kParse, "the message has unknown members");
    return {};
  }
  static Result<std::uint32_t> index_of(const PageJson& value, const char* name) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffU) {
      return wrong(name, "a whole number from 0 to 4294967295");
    }
    return value.get<std::uint32_t>();
  }

 private:
  static tl::unexpected<Error> wrong(const char* name, const char* expected) {
    return fail(ErrorCode::kParse, "`{}`: expected {}", name, expected);
  }
  Result<const PageJson*> find(const char* name) {
    const auto found = object_.find(name);
    if (found == object_.end()) return fail(ErrorCode::kParse, "`{}` is missing", name);
    ++taken_;
    return &*found;
  }

  const PageJson& object_;
  std::size_t taken_ = 0;
};

}  // namespace rave::gui_server
