// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave {

/// The text for HTML or XML, between tags or in a quoted attribute.
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace rave
