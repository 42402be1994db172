// SPDX-License-Identifier: Apache-2.0
#include "people/free_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "rave/base/plain_name.hpp"

namespace rave::gui_server {
namespace {

constexpr std::size_t kMostAccounts = 5000;
/// How lists, the chat and the audit log call those who have no account.
constexpr std::array<std::string_view, 5> kOwnNames = {"you", "operator", "terminal", "unknown",
                                                       "server"};

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// `Anna` and `anna` would be mistaken for each other in lists and in the audit log.
bool same_but_for_capitals(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

tl::unexpected<Error> taken(std::string_view name) {
  return fail(ErrorCode::kInvalidArgument, "the name `{}` is taken", name);
}

void replace_pair(std::string& text, std::string_view pair, char by) {
  for (std::size_t at = 0; (at = text.find(pair, at)) != std::string::npos;) {
    text.replace(at, pair.size(), 1, by);
  }
}

}  // namespace

std::string look_of(std::string_view name) {
  std::string look;
  for (const char c : name) {
    if (!is_plain(c, "")) continue;
    const char small = lower(c);
    const bool stroke = small == '1' || small == 'i';
    look += small == '0' ? 'o' : stroke ? 'l' : small;
  }
  replace_pair(look, "rn", 'm');
  replace_pair(look, "vv", 'w');
  return look;
}

Status check_free(const AccountsFile& file, std::string_view name) {
  for (const std::string_view own : kOwnNames) {
    if (same_but_for_capitals(own, name)) return taken(name);
  }
  for (const Account& account : file.accounts) {
    if (same_but_for_capitals(account.person.name, name)) return taken(account.person.name);
  }
  if (file.accounts.size() < kMostAccounts) return {};
  return fail(ErrorCode::kInvalidArgument,
              "this server already has {} accounts, which is the maximum", kMostAccounts);
}

Status check_chosen(const AccountsFile& file, std::string_view name, const NameSet& kept) {
  RAVE_TRY(check_free(file, name));
  const std::string look = look_of(name);
  const auto alike = [&look](std::string_view other) { return look_of(other) == look; };
  const bool like_own = std::ranges::any_of(kOwnNames, alike);
  const bool like_kept = std::ranges::any_of(kept, alike);
  const bool like_account = std::ranges::any_of(
      file.accounts, [&](const Account& account) { return alike(account.person.name); });
  const bool like_invited = std::ranges::any_of(file.invitations, [&](const Invitation& other) {
    return !other.name.empty() && alike(other.name);
  });
  // Not whose it is like: a stranger need not learn which names there are.
  if (like_own || like_kept || like_account || like_invited) {
    return fail(ErrorCode::kInvalidArgument,
                "the name `{}` is taken, or too like another; choose a different one", name);
  }
  return {};
}

}  // namespace rave::gui_server
