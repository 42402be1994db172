// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rave/codec/codec_base.hpp"

namespace rave::request {

/// To whom a line of the chat goes.
enum class Addressee : std::uint8_t { kAll, kRole, kUser, kTeam, kRobot };
constexpr auto enum_names(codec::EnumTag<Addressee>) {
  using codec::EnumName;
  return std::array{EnumName{Addressee::kAll, "all"}, EnumName{Addressee::kRole, "role"},
                    EnumName{Addressee::kUser, "user"}, EnumName{Addressee::kTeam, "team"},
                    EnumName{Addressee::kRobot, "robot"}};
}

/// `all`, `role`, …; and the inverse, empty for any other word.
[[nodiscard]] std::string_view to_string(Addressee to) noexcept;
[[nodiscard]] std::optional<Addressee> addressee(std::string_view word) noexcept;

inline constexpr std::size_t kMostChatName = 256;

/// A line of the chat, for the recording of the run; no input of the run.
struct Chat {
  static constexpr std::string_view kName = "chat";
  std::uint64_t number = 0;  ///< At its server, from 1.
  std::string role{};        ///< Of the sender: `observer`, `commander` or `super_user`.
  Addressee to = Addressee::kAll;
  std::string name{};  ///< Of the receiver; empty for kAll. At most kMostChatName bytes.
  std::string text{};  ///< 1 to kMostOrderText bytes.
  friend bool operator==(const Chat&, const Chat&) = default;
};

}  // namespace rave::request
