// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::bus {

/// Which run a sample belongs to: 128 random bits that whoever starts a run draws and hands to all
/// of its processes. All zero means none. A value; any thread.
struct RunId {
  std::array<std::uint8_t, 16> bytes{};

  /// From the operating system's source of chance. Not part of what a run computes with.
  [[nodiscard]] static RunId random();
  /// The same for all who know a number, such as the hash of a name that people can say.
  [[nodiscard]] static RunId of(std::uint64_t number);
  /// 32 hexadecimal digits, as text() writes them. Error: kParse.
  [[nodiscard]] static Result<RunId> parse(std::string_view text);

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool none() const noexcept { return *this == RunId{}; }
  [[nodiscard]] bool equals(const std::uint8_t (&wire)[16]) const noexcept {
    return std::memcmp(bytes.data(), wire, sizeof wire) == 0;
  }

  friend bool operator==(const RunId&, const RunId&) noexcept = default;
};

/// The name of one start of one process: 64 random bits, never 0.
[[nodiscard]] std::uint64_t random_writer_id();

}  // namespace rave::bus
