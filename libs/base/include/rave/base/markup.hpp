// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave {

/// Text as it may stand in HTML and XML, also between quotes of an attribute.
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace rave
