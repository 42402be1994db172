// SPDX-License-Identifier: Apache-2.0
#include "rave/base/log.hpp"

#include "rave/base/word_table.hpp"

namespace rave {
namespace {

constexpr WordTable<LogLevel, 4> kLevels = {{
    {"debug", LogLevel::kDebug},
    {"info", LogLevel::kInfo},
    {"warning", LogLevel::kWarning},
    {"error", LogLevel::kError},
}};

}  // namespace

std::string_view to_string(LogLevel level) noexcept { return kLevels.of(level, "unknown"); }

}  // namespace rave
