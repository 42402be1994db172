// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave::config {

/// How an unquoted scalar reads by the core schema of YAML 1.2, without its octal and hexadecimal
/// numbers. Numbers with leading zeros are text, because YAML 1.1 reads them as octal.
enum class PlainType { kNull, kBool, kWhole, kReal, kInfinite, kNan, kText };

[[nodiscard]] PlainType plain_type(std::string_view text) noexcept;

/// The shortest text that reads back as the same double and that both YAML 1.1 and 1.2 take for a
/// number.
[[nodiscard]] std::string number_text(double value);

}  // namespace rave::config
