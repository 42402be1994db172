// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::bus {

/// The id of a run: 128 random bits. The process that starts a run draws it and passes it to all
/// others. All zero means none. A value; any thread.
struct RunId {
  std::array<std::uint8_t, 16> bytes{};

  /// From the random source of the operating system, not from the seed of the run.
  [[nodiscard]] static RunId random();
  /// Parses the 32 hexadecimal digits of text(). Error: kParse.
  [[nodiscard]] static Result<RunId> parse(std::string_view text);

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool none() const noexcept { return *this == RunId{}; }
  [[nodiscard]] bool equals(const std::uint8_t (&wire)[16]) const noexcept {
    return std::memcmp(bytes.data(), wire, sizeof wire) == 0;
  }

  friend bool operator==(const RunId&, const RunId&) noexcept = default;
};

/// The run id for a name that people agree on: a hash, equal everywhere.
[[nodiscard]] RunId run_of_name(std::string_view name) noexcept;
/// The run id for a number, such as a seed: a hash, equal everywhere.
[[nodiscard]] RunId run_of_number(std::uint64_t number) noexcept;

/// A new writer id, for one execution of one process: 64 random bits, never 0.
[[nodiscard]] std::uint64_t random_writer_id();

}  // namespace rave::bus
