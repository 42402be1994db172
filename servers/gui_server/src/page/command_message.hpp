// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "page/members.hpp"
#include "rave/gui_server/command.hpp"

namespace rave::gui_server {

/// The messages `order`, `lease`, `set`, `edit` and `twin`; nothing for any other type. Numbers are
/// finite and within bounds that no world reaches. Errors: kParse with what was expected.
[[nodiscard]] std::optional<Result<CommandMessage>> command_of(std::string_view type,
                                                               Members& members);

}  // namespace rave::gui_server
