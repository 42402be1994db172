// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace rave {

/// The kind of failure that an Error reports. The list is short on purpose: callers compare it only
/// to treat two failures differently; everything else is in the message.
enum class ErrorCode : std::uint8_t {
  kInvalidArgument,  ///< A caller's value is outside what the function accepts.
  kParse,            ///< Text or bytes do not follow their format.
  kNotFound,         ///< A file, name or symbol that was asked for does not exist.
  kIo,               ///< The operating system refused a read, write or map.
  kIncompatible,     ///< Two parts were built for different interfaces.
  kPlugin,           ///< A driver or program reported a failure of its own.
  kTimeout,          ///< Something did not answer within its limit.
  kState,            ///< The call is not allowed in the present state.
};

/// The stable lower-case name of a code, for logs and result files.
[[nodiscard]] std::string_view to_string(ErrorCode code) noexcept;

/// A place in a text file. Lines and columns count from 1; 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;

  /// `file:line:column`, leaving out what is unknown; empty if there is no file.
  [[nodiscard]] std::string text() const;
};

/// One failure, complete enough to be shown to a user as it is.
struct Error {
  ErrorCode code = ErrorCode::kInvalidArgument;
  /// What went wrong, what was expected, and how to correct it; no trailing full stop or newline.
  std::string message;
  /// Where in the user's files, if anywhere.
  SourceLocation where;

  /// `file:line:column: message`, or the message alone when no place is known.
  [[nodiscard]] std::string text() const;

  /// The same error with `context` and a colon put before the message.
  [[nodiscard]] Error with_context(std::string_view context) &&;
};

}  // namespace rave
