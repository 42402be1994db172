// SPDX-License-Identifier: Apache-2.0
#include "rave/base/error.hpp"

#include <fmt/format.h>

namespace rave {

std::string_view to_string(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return "invalid_argument";
    case ErrorCode::kParse:
      return "parse";
    case ErrorCode::kNotFound:
      return "not_found";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kIncompatible:
      return "incompatible";
    case ErrorCode::kPlugin:
      return "plugin";
    case ErrorCode::kTimeout:
      return "timeout";
    case ErrorCode::kState:
      return "state";
  }
  return "unknown";
}

std::string SourceLocation::text() const {
  if (file.empty()) return {};
  if (line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

std::string Error::text() const {
  const std::string place = where.text();
  return place.empty() ? message : fmt::format("{}: {}", place, message);
}

Error Error::with_context(std::string_view context) && {
  message = fmt::format("{}: {}", context, message);
  return std::move(*this);
}

}  // namespace rave
