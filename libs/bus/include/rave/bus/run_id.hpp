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
  /// 32 hexadecimal digits, as text() writes them. Error: kParse.
  [[nodiscard]] static Result<RunId> parse(std::string_view text);

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool none() const noexcept { return *this == RunId{}; }
  [[nodiscard]] bool equals(const std::uint8_t (&wire)[16]) const noexcept {
    return std::memcmp(bytes.data(), wire, sizeof wire) == 0;
  }

  friend bool operator==(const RunId&, const RunId&) noexcept = default;
};

/// The number of a run that people call by a name: the same for all who know the name.
[[nodiscard]] RunId run_of_name(std::string_view name) noexcept;
/// The same by a number of what the run does.
[[nodiscard]] RunId run_of_number(std::uint64_t number) noexcept;

/// The name of one start of one process: 64 random bits, never 0.
[[nodiscard]] std::uint64_t random_writer_id();

}  // namespace rave::bus
