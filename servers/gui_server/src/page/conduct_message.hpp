// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "page/members.hpp"
#include "rave/gui_server/conductor.hpp"

namespace rave::gui_server {

/// As answers say it: `start`, `end`, and so on.
[[nodiscard]] std::string_view word_of(ConductMessage::Do what) noexcept;

/// The message `conduct`; nothing for any other type. Errors: kParse with what was expected.
[[nodiscard]] std::optional<Result<ConductMessage>> conduct_message_of(std::string_view type,
                                                                       Members& members);

}  // namespace rave::gui_server
