// SPDX-License-Identifier: Apache-2.0
#include "rave/request/chat.hpp"

#include <algorithm>

namespace rave::request {
namespace {

constexpr auto kNames = enum_names(codec::EnumTag<Addressee>());

}  // namespace

std::string_view to_string(Addressee to) noexcept {
  const auto* const name = std::ranges::find(kNames, to, &codec::EnumName<Addressee>::value);
  return name != kNames.end() ? name->name : "unknown";
}

std::optional<Addressee> addressee(std::string_view word) noexcept {
  const auto* const name = std::ranges::find(kNames, word, &codec::EnumName<Addressee>::name);
  return name != kNames.end() ? std::optional(name->value) : std::nullopt;
}

}  // namespace rave::request
