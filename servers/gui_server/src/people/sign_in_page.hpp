// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/web/message.hpp"

// The pages that strangers see: plain HTML without a script. They say nothing of the run.
namespace rave::gui_server {

/// The form of `/login`. `note`: what went wrong; empty: nothing yet. `name`: as it was typed.
[[nodiscard]] web::Response sign_in_page(int status, std::string_view note, std::string_view name);

/// What the form of `/join` says.
struct JoinForm {
  std::string_view note;  ///< What went wrong; empty: nothing yet.
  std::string_view name;
  std::string_view invitation;  ///< Its secret.
  bool name_is_fixed = false;   ///< The invitation is for this name alone.
};
[[nodiscard]] web::Response join_page(int status, const JoinForm& form);

/// A page with a sentence, and a link to `/login` if people sign in here.
[[nodiscard]] web::Response told_page(int status, std::string_view sentence, bool sign_in);

/// A page that leads to `/`, as a link of this server.
[[nodiscard]] web::Response onward_page();

/// `/login.css`.
[[nodiscard]] web::Response sign_in_style();

}  // namespace rave::gui_server
