// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/json_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rave/base/names.hpp"
#include "rave/base/plain_name.hpp"

namespace rave::direct_line {
namespace {

tl::unexpected<Error> wrong(const char* name, std::string_view expected) {
  return fail(ErrorCode::kParse, "`{}`: expected {}", name, expected);
}

}  // namespace

Result<bool> JsonMembers::flag(const char* name) {
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  if (!value->is_boolean()) return wrong(name, "true or false");
  return value->get<bool>();
}

Result<double> JsonMembers::number(const char* name) {
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  return number_of(*value, name);
}

Result<double> JsonMembers::number_in(const char* name, double least, double most) {
  RAVE_TRY_ASSIGN(const double value, number(name));
  if (value >= least && value <= most) return value;
  return wrong(name, fmt::format("a number from {} to {}", least, most));
}

Result<std::uint64_t> JsonMembers::whole(const char* name) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53U;
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  if (value->is_number_unsigned() && value->get<std::uint64_t>() <= kMost) {
    return value->get<std::uint64_t>();
  }
  return wrong(name, "a whole number from 0");
}

Result<std::uint32_t> JsonMembers::index(const char* name) {
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  return index_of(*value, name);
}

Result<std::uint32_t> JsonMembers::index_in(const char* name, std::uint32_t least,
                                            std::uint32_t most) {
  RAVE_TRY_ASSIGN(const std::uint32_t value, index(name));
  if (value >= least && value <= most) return value;
  return wrong(name, fmt::format("{} to {}", least, most));
}

Result<std::string> JsonMembers::word(const char* name) {
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  if (!value->is_string()) return wrong(name, "a string");
  return value->get<std::string>();
}

Result<std::string> JsonMembers::text(const char* name, std::size_t most, bool lines) {
  RAVE_TRY_ASSIGN(std::string text, word(name));
  const bool plain = std::ranges::none_of(text, [lines](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && !(lines && c == '\n')) || c == 0x7f;
  });
  if (text.size() <= most && plain) return text;
  return wrong(name, fmt::format("at most {} bytes of text", most));
}

Result<std::string> JsonMembers::plain_name(const char* name, std::string_view signs) {
  RAVE_TRY_ASSIGN(std::string text, word(name));
  if (text.size() <= kLongestPlainName && is_plain_name(text, signs)) return text;
  return wrong(name, fmt::format("letters, digits and `{}`, at most {}", signs, kLongestPlainName));
}

Result<std::string_view> JsonMembers::choice(const char* name,
                                             std::initializer_list<std::string_view> words) {
  RAVE_TRY_ASSIGN(const std::size_t row, row_of(name, {words.begin(), words.size()}));
  return words.begin()[row];
}

Result<Pose2> JsonMembers::pose(const char* name, double farthest_m) {
  RAVE_TRY_ASSIGN(const std::vector<double> numbers, list(name, 3, number_of));
  const bool good = numbers.size() == 3 && std::abs(numbers[0]) <= farthest_m &&
                    std::abs(numbers[1]) <= farthest_m &&
                    std::abs(numbers[2]) <= 2 * std::numbers::pi;
  if (good) return Pose2{numbers[0], numbers[1], numbers[2]};
  return wrong(name, fmt::format("x, y in metres and yaw in radians, at most {} m and one turn",
                                 farthest_m));
}

Result<const Json*> JsonMembers::any(const char* name) {
  const auto found = object_.find(name);
  if (found == object_.end()) return fail(ErrorCode::kParse, "`{}` is missing", name);
  ++taken_;
  return &*found;
}

Status JsonMembers::finish() const {
  if (object_.size() != taken_) return fail(ErrorCode::kParse, "the message has unknown members");
  return {};
}

Result<Json> JsonMembers::parse_object(std::string_view text, const char* what) {
  // No valid message is nested deeper; the parser itself has no limit.
  constexpr int kDeepest = 6;
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepest; };
  Json object = Json::parse(text, shallow, false);
  if (!object.is_object()) return fail(ErrorCode::kParse, "not a valid {}", what);
  return object;
}

Result<double> JsonMembers::number_of(const Json& value, const char* name) {
  if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
  return wrong(name, "a finite number");
}

Result<std::uint32_t> JsonMembers::index_of(const Json& value, const char* name) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffU) {
    return wrong(name, "a whole number from 0 to 4294967295");
  }
  return value.get<std::uint32_t>();
}

Result<std::size_t> JsonMembers::row_of(const char* name, std::span<const std::string_view> words) {
  RAVE_TRY_ASSIGN(const std::string word, this->word(name));
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) return wrong(name, join_names(words, "or"));
  return static_cast<std::size_t>(found - words.begin());
}

Result<const Json*> JsonMembers::array(const char* name, std::size_t most) {
  RAVE_TRY_ASSIGN(const Json* const value, any(name));
  if (value->is_array() && value->size() <= most) return value;
  return wrong(name, fmt::format("an array of at most {}", most));
}

}  // namespace rave::direct_line
