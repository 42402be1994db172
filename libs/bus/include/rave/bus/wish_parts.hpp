// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

// An answer that is longer than one message goes in several: each begins with `from BYTE of BYTES:
// ` and is asked for by a wish of the same number that says `from BYTE`. An answer that fits goes
// as it is; none begins like a part. Pure; any thread.
namespace rave::bus {

/// Most bytes of an answer in all its parts.
inline constexpr std::size_t kMostAnswerBytes = std::size_t{8} << 20U;

/// The message with what an answer has from this byte on. Nothing: it has no such byte.
[[nodiscard]] std::optional<std::string> answer_part(std::string_view answer, std::size_t from);

/// The wish for the rest of an answer, and where the rest begins that a wish is for; 0 for any
/// other wish.
[[nodiscard]] std::string wish_for_rest(std::size_t from);
[[nodiscard]] std::size_t rest_wished(std::string_view wish) noexcept;

/// Puts an answer together. One owner thread.
class AnswerParts {
 public:
  /// The next message. A part that was there before changes nothing. Error kParse: it is not what
  /// follows, or is of another or too long an answer, or less than a part has; nothing is kept of
  /// it.
  [[nodiscard]] Status add(std::string_view message);
  /// Whether all of it is there.
  [[nodiscard]] bool complete() const noexcept { return total_ > 0 && text_.size() == total_; }
  /// What is there, from the beginning.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::size_t total_ = 0;  ///< 0: nothing has come.
  std::string text_;
};

}  // namespace rave::bus
