// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {

/// What a name looks like: equal for names that a reader would confuse. Capitals, signs, and `0`
/// and `o`, `1`, `i` and `l`, `rn` and `m`, `vv` and `w` do not count.
[[nodiscard]] std::string look_of(std::string_view name);

/// Whether an account may be added with a name that is given to it. Error kInvalidArgument: one of
/// the names that the server says itself, or the name of another account, but for capitals.
[[nodiscard]] Status check_free(const AccountsFile& file, std::string_view name);

/// The same of a name that an invited person chose. It must not look like that of an account, of an
/// invitation for another person, or one of `kept`.
[[nodiscard]] Status check_chosen(const AccountsFile& file, std::string_view name,
                                  const NameSet& kept);

}  // namespace rave::gui_server
