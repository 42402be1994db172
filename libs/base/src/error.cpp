// SPDX-License-Identifier: Apache-2.0
#include "rave/base/error.hpp"

#include <fmt/format.h>

#include "rave/base/word_table.hpp"

namespace rave {
namespace {

constexpr WordTable<ErrorCode, 8> kCodes = {{
    {"invalid_argument", ErrorCode::kInvalidArgument},
    {"parse", ErrorCode::kParse},
    {"not_found", ErrorCode::kNotFound},
    {"io", ErrorCode::kIo},
    {"incompatible", ErrorCode::kIncompatible},
    {"plugin", ErrorCode::kPlugin},
    {"timeout", ErrorCode::kTimeout},
    {"state", ErrorCode::kState},
}};

}  // namespace

std::string_view to_string(ErrorCode code) noexcept { return kCodes.of(code, "unknown"); }

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
