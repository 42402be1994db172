// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

// An answer longer than one message is sent in parts. Each part begins with `from BYTE of BYTES: `;
// the next is requested by a request of the same number with the text `from BYTE`. A short answer
// is sent unchanged; no answer begins like a part. Pure; any thread.
namespace rave::bus {

/// Size limit of an answer, all parts together (bytes).
inline constexpr std::size_t kMostAnswerBytes = std::size_t{8} << 20U;

/// The message that carries the answer from byte `from` on. Empty: the answer has no such byte.
[[nodiscard]] std::optional<std::string> answer_part(std::string_view answer, std::size_t from);

/// The request for the rest of an answer, and its inverse: the byte that such a request names; 0
/// for any other request.
[[nodiscard]] std::string request_for_rest(std::size_t from);
[[nodiscard]] std::size_t rest_requested(std::string_view request) noexcept;

/// Assembles an answer from its parts. One owner thread.
class AnswerParts {
 public:
  /// Adds the next message. A repeated part changes nothing. Error kParse: the part does not follow
  /// the last one, belongs to another answer, is too short, or the answer is too long; nothing of
  /// it is kept.
  [[nodiscard]] Status add(std::string_view message);
  /// Whether all parts are present.
  [[nodiscard]] bool complete() const noexcept { return total_ > 0 && text_.size() == total_; }
  /// The text so far, from the beginning.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::size_t total_ = 0;  ///< 0: nothing was added yet.
  std::string text_;
};

}  // namespace rave::bus
