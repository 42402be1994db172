// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Numbers and names for narrow columns.
namespace rave::watch {

/// `310 us`, `4.2 ms`, `45 ms`, `1.3 s`, `215 s`.
[[nodiscard]] std::string time_text(double seconds);
/// Three significant digits: `0.50`, `9.90`, `49.8`, `4890`.
[[nodiscard]] std::string number_text(double value);
/// `+1.20±0.08 ms`: both in one unit.
[[nodiscard]] std::string offset_text(double offset_s, double bound_s);

/// Removes control characters; a text wider than `width` columns ends in `…`.
[[nodiscard]] std::string fitted(std::string_view text, std::size_t width);

}  // namespace rave::watch
