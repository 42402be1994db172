// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave people add|invite|list|remove|uninvite`: who may watch a run over the network.
struct PeopleCommand {
  enum class What { kAdd, kInvite, kList, kRemove, kUninvite } what = What::kList;
  std::string folder;  ///< Of the accounts; empty: that of the user.
  std::string name;
  std::string role = "observer";
  std::string teams = "*";
  int uses = 1;
  int days = 7;
};

/// Passwords come from the terminal, without being shown, or as the first line of what is piped in.
/// Returns 0, or 2 on bad input.
[[nodiscard]] Result<int> people(const PeopleCommand& options);

}  // namespace rave::cli
