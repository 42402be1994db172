// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave::codec {

/// The type of an unquoted scalar in the core schema of YAML 1.2, without octal and hexadecimal
/// numbers. Numbers with leading zeros are text, because YAML 1.1 reads them as octal.
enum class PlainType { kNull, kBool, kWhole, kReal, kInfinite, kNan, kText };

[[nodiscard]] PlainType plain_type(std::string_view text) noexcept;

/// The shortest text that reads back as the same double and is a number in both YAML 1.1 and 1.2.
[[nodiscard]] std::string number_text(double value);

}  // namespace rave::codec
