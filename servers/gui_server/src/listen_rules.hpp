// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/gui_server/accounts.hpp"
#include "rave/gui_server/gui_server.hpp"

namespace rave::gui_server {

/// Whether a server that others can reach has what that needs: TLS, and a super-user to let them
/// in. Error kInvalidArgument.
[[nodiscard]] Status check_listen(const GuiOptions& options, const Accounts* accounts);

}  // namespace rave::gui_server
