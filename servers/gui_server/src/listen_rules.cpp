// SPDX-License-Identifier: Apache-2.0
#include "listen_rules.hpp"

#include <algorithm>

#include "rave/web/rate_limit.hpp"

namespace rave::gui_server {

Status check_listen(const GuiOptions& options, const Accounts* accounts) {
  if (web::is_loopback(options.listen)) return {};
  if (options.certificate.empty() || options.key.empty()) {
    return fail(
        ErrorCode::kInvalidArgument,
        "to listen on {} needs TLS: `rave keys web web-keys NAME`, with the name or address that "
        "people type, makes a certificate; then add --certificate web-keys/server.pem --key "
        "web-keys/server_key.pem",
        options.listen);
  }
  if (accounts == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "to listen on {} needs accounts: add --accounts DIR",
                options.listen);
  }
  const AccountsFile state = accounts->state();
  const bool has_super_user = std::ranges::any_of(state.accounts, [](const Account& account) {
    return account.person.role == Role::kSuperUser && !account.disabled;
  });
  if (has_super_user) return {};
  return fail(ErrorCode::kInvalidArgument,
              "to listen on {} needs accounts, and `{}` has no super-user: `rave people add YOU "
              "--role super_user --accounts {}` makes one",
              options.listen, accounts->folder().string(), accounts->folder().string());
}

}  // namespace rave::gui_server
