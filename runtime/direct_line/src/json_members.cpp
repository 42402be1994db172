// SPDX-License-Identifier: Apache-2.0
#include "json_members.hpp"

#include <cmath>

namespace rave::direct_line {
namespace {

constexpr std::uint64_t kMostWhole = std::uint64_t{1} << 53U;
/// No valid message is nested deeper; the JSON parser itself has no limit.
constexpr int kDeepest = 6;

tl::unexpected<Error> wrong_member(const char* name, const char* expected) {
  return fail(ErrorCode::kParse, "`{}`: expected {}", name, expected);
}

}  // namespace

Result<nlohmann::json> JsonMembers::parse_object(std::string_view text, const char* what) {
  const auto shallow = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    return depth <= kDeepest;
  };
  auto object = nlohmann::json::parse(text, shallow, false);
  if (!object.is_object()) return fail(ErrorCode::kParse, "not a valid {}", what);
  return object;
}

Result<const nlohmann::json*> JsonMembers::any(const char* name) {
  const auto found = object_.find(name);
  if (found == object_.end()) return fail(ErrorCode::kParse, "`{}` is missing", name);
  ++taken_;
  return &*found;
}

Result<double> JsonMembers::number(const char* name) {
  RAVE_TRY_ASSIGN(const nlohmann::json* const value, any(name));
  if (!value->is_number() || !std::isfinite(value->get<double>())) {
    return wrong_member(name, "a finite number");
  }
  return value->get<double>();
}

Result<std::uint64_t> JsonMembers::whole(const char* name) {
  RAVE_TRY_ASSIGN(const nlohmann::json* const value, any(name));
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() > kMostWhole) {
    return wrong_member(name, "a whole number from 0");
  }
  return value->get<std::uint64_t>();
}

Result<bool> JsonMembers::flag(const char* name) {
  RAVE_TRY_ASSIGN(const nlohmann::json* const value, any(name));
  if (!value->is_boolean()) return wrong_member(name, "true or false");
  return value->get<bool>();
}

Result<std::string> JsonMembers::text(const char* name, std::size_t most) {
  RAVE_TRY_ASSIGN(const nlohmann::json* const value, any(name));
  if (!value->is_string()) return wrong_member(name, "a string");
  auto text = value->get<std::string>();
  if (text.size() > most) {
    return fail(ErrorCode::kParse, "`{}`: expected at most {} bytes", name, most);
  }
  return text;
}

Status JsonMembers::finish() const {
  if (object_.size() != taken_) return fail(ErrorCode::kParse, "unknown members");
  return {};
}

}  // namespace rave::direct_line
