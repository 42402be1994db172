// SPDX-License-Identifier: Apache-2.0
#include "commands/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "error_text.hpp"
#include "rave/base/table.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/keys/key_set.hpp"
#include "rave/keys/web_keys.hpp"

namespace rave::cli {
namespace {

/// Who has less than this left is warned of.
constexpr std::int64_t kSoon_days = 30;

std::int64_t now_s() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

/// `lab-keys/` and `lab-keys` in the same way.
std::string plain(std::string folder) {
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  return folder;
}

std::vector<TableCell> row_of(const keys::KeyInfo& key) {
  if (key.fingerprint.empty()) return {key.name, "unreadable"};
  return {key.name, keys::date_text(key.from_s), keys::date_text(key.until_s),
          fmt::format("{}", key.days_left(now_s())), key.fingerprint};
}

/// Complains of what is wrong with a key and warns of what soon will be. Whether it can be used.
bool judge(const keys::KeyInfo& key, const Terminal& terminal) {
  std::vector<std::string> problems = key.problems;
  const std::int64_t days = key.days_left(now_s());
  if (!key.fingerprint.empty() && days < 0) {
    problems.push_back("expired on " + keys::date_text(key.until_s));
  }
  if (!key.fingerprint.empty() && key.from_s > now_s()) {
    problems.push_back("not valid before " + keys::date_text(key.from_s));
  }
  for (const std::string& problem : problems) {
    put(stderr, fmt::format("{}{}: {}\n", terminal.red("rave: "), key.name, problem));
  }
  if (!key.fingerprint.empty() && days >= 0 && days < kSoon_days) {
    const std::string left =
        days == 0 ? "less than a day" : fmt::format("{} day{}", days, days == 1 ? "" : "s");
    put(stderr, fmt::format("{}{} expires in {}, on {}\n", terminal.yellow("warning: "), key.name,
                            left, keys::date_text(key.until_s)));
  }
  return problems.empty();
}

/// Gives members the public key of tickets, whose secret half is `line.key` of the set. A set of an
/// older version gets one as well, and members that have none.
Status give_line_key(const std::filesystem::path& folder) {
  const std::filesystem::path secret = folder / "line.key";
  const std::filesystem::path open = folder / "line.key.pub";
  std::error_code error;
  if (!std::filesystem::exists(open, error)) RAVE_TRY(direct_line::make_key_files(secret));
  RAVE_TRY_ASSIGN(const direct_line::PublicKey key, direct_line::read_public_key(open));
  RAVE_TRY_ASSIGN(const keys::KeySetInfo set, keys::read_key_set(folder));
  for (const keys::KeyInfo& member : set.members) {
    const auto file = folder / member.name / direct_line::kMemberKeyFile;
    if (!std::filesystem::exists(file, error)) RAVE_TRY(direct_line::write_public_key(file, key));
  }
  return {};
}

}  // namespace

Result<int> new_keys(const KeysNewCommand& options) {
  const std::string folder = plain(options.folder);
  RAVE_TRY(keys::make_key_set({folder, options.lab, options.days, options.members, now_s()}));
  RAVE_TRY(give_line_key(folder));
  put(stdout,
      fmt::format("created {0} for {1}; valid for {2} days\n"
                  "next: copy {0}/{3} to where {3} runs, and start it there with\n"
                  "  --security {3}\n"
                  "Keep {0}/ca secret: whoever has it can create members. {0}/line.key is "
                  "for the\nGUI Server alone (--line-key): whoever has it can command every "
                  "robot.\n",
                  folder, fmt::join(options.members, ", "), options.days, options.members.front()));
  return kGood;
}

Result<int> add_keys(const KeysAddCommand& options) {
  const std::string folder = plain(options.folder);
  RAVE_TRY(keys::add_members(folder, options.members, options.days, now_s()));
  RAVE_TRY(give_line_key(folder));
  put(stdout, fmt::format("added {} to {}\n", fmt::join(options.members, ", "), folder));
  return kGood;
}

Result<int> show_keys(const KeysShowCommand& options) {
  RAVE_TRY_ASSIGN(const auto set, keys::read_key_set(plain(options.folder)));
  Table table{"lab " + set.lab,
              {{""}, {"from"}, {"until"}, {"days left", Align::kRight}, {"SHA-256"}},
              {row_of(set.authority)},
              {}};
  for (const keys::KeyInfo& member : set.members) table.rows.push_back(row_of(member));
  put(stdout, render_table(table, {.look = TableLook::kSpaces}));
  const Terminal terminal = terminal_of(stderr);
  bool usable = judge(set.authority, terminal);
  // All are judged, also behind one that cannot be used.
  for (const keys::KeyInfo& member : set.members) usable = judge(member, terminal) && usable;
  return usable ? kGood : kNotGood;
}

Result<int> web_keys(const KeysWebCommand& options) {
  const std::string folder = plain(options.folder);
  RAVE_TRY_ASSIGN(const auto made,
                  keys::make_web_keys({folder, options.names, options.days, now_s()}));
  put(stdout,
      fmt::format("{} {} for {}; valid until {}\n", made.new_authority ? "created" : "renewed in",
                  folder, fmt::join(options.names, ", "), keys::date_text(made.until_s)));
  if (made.new_authority) {
    put(stdout,
        fmt::format(
            "next: tell browsers once to trust {0}/authority.pem\n"
            "  SHA-256 {1}\n"
            "Keep {0}/authority_key.pem secret: whoever has it can impersonate this server.\n",
            folder, made.fingerprint));
  }
  put(stdout,
      fmt::format("serve with  --certificate {0}/server.pem --key {0}/server_key.pem\n", folder));
  return kGood;
}

Result<int> line_keys(const KeysLineCommand& options) {
  RAVE_TRY(direct_line::make_key_files(options.file));
  put(stdout, fmt::format("created {0} and {0}.pub\n"
                          "next: rave gui SCENARIO --line-key {0}\n"
                          "      rave robot SCENARIO --host NAME --web --web-key {0}.pub\n"
                          "Whoever has {0} can command every robot: keep it secret.\n",
                          options.file));
  return kGood;
}

}  // namespace rave::cli
