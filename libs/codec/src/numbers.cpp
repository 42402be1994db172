// SPDX-License-Identifier: Apache-2.0
// Which type a plain scalar has: a narrow part of the core schema of YAML 1.2, without its octal
// and hexadecimal numbers.
#include "rave/codec/numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace rave::codec {
namespace {

std::size_t count_digits(std::string_view text) noexcept {
  std::size_t n = 0;
  while (n < text.size() && text[n] >= '0' && text[n] <= '9') ++n;
  return n;
}

bool is_exponent(std::string_view text) noexcept {
  if (text.empty() || (text[0] != 'e' && text[0] != 'E')) return false;
  text.remove_prefix(1);
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  return !text.empty() && count_digits(text) == text.size();
}

PlainType number_type(std::string_view text) noexcept {
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return PlainType::kNan;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  if (text == ".inf" || text == ".Inf" || text == ".INF") return PlainType::kInfinite;
  const std::size_t whole = count_digits(text);
  // YAML 1.1 reads 010 as eight and YAML 1.2 as ten: here it is a text, and a field of numbers
  // refuses it.
  if (whole > 1 && text[0] == '0') return PlainType::kText;
  text.remove_prefix(whole);
  if (text.empty()) return whole > 0 ? PlainType::kWhole : PlainType::kText;
  std::size_t fraction = 0;
  if (text[0] == '.') {
    text.remove_prefix(1);
    fraction = count_digits(text);
    text.remove_prefix(fraction);
  }
  const bool has_digits = whole + fraction > 0;
  return has_digits && (text.empty() || is_exponent(text)) ? PlainType::kReal : PlainType::kText;
}

}  // namespace

PlainType plain_type(std::string_view text) noexcept {
  for (const std::string_view null : {"", "~", "null", "Null", "NULL"}) {
    if (text == null) return PlainType::kNull;
  }
  for (const std::string_view flag : {"true", "True", "TRUE", "false", "False", "FALSE"}) {
    if (text == flag) return PlainType::kBool;
  }
  return number_type(text);
}

std::string number_text(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  // `-0` would be read as the integer 0, which has no sign.
  if (value == 0 && std::signbit(value)) return "-0.0";
  std::string text = fmt::format("{}", value);
  // YAML 1.1 reads `1e+21` as text; it requires a decimal point.
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

}  // namespace rave::codec
