// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/checks.hpp"
#include "rave/keys/key_set.hpp"

namespace rave::doctor {
namespace {

constexpr std::int64_t kSoon_days = 30;

}  // namespace

Finding check_keys(const std::filesystem::path& folder, std::int64_t now_s) {
  if (folder.empty()) {
    return {"keys", Verdict::kGood, "none: any process on the network can take part", {}};
  }
  const auto problem = [&](std::string what, std::string mend) {
    return Finding{"keys", Verdict::kProblem, std::move(what), std::move(mend)};
  };
  const std::string again = fmt::format(
      "rave keys show {0}    # then copy {0} again from where "
      "`rave keys new` made it",
      folder.string());
  const auto set = keys::read_key_set(folder);
  if (!set) return problem(set.error().message, again);
  std::error_code error;
  // A common mistake: the folder of the whole set instead of that of one member.
  if (!std::filesystem::exists(folder / "identity.pem", error) || set->members.empty()) {
    return problem(
        fmt::format("{} is a complete set of keys; a process needs the folder of one member",
                    folder.string()),
        fmt::format("--security {}", (folder / (set->members.empty() ? std::string("MEMBER")
                                                                     : set->members.front().name))
                                         .string()));
  }
  for (const keys::KeyInfo* const key : {&set->members.front(), &set->authority}) {
    if (!key->problems.empty()) {
      return problem(fmt::format("{}: {}", key->name, key->problems.front()), again);
    }
    if (now_s < key->from_s) {
      return problem(
          fmt::format("{} is not valid before {}, according to the clock of this machine",
                      key->name, keys::date_text(key->from_s)),
          "sudo timedatectl set-ntp true");
    }
    if (now_s > key->until_s) {
      return problem(fmt::format("{} expired on {}", key->name, keys::date_text(key->until_s)),
                     fmt::format("rm -r SET/{0} && rave keys add SET {0}    # where the set is; "
                                 "then copy it here",
                                 key->name));
    }
  }
  const keys::KeyInfo& member = set->members.front();
  const std::string what =
      fmt::format("{} of {}, until {}", member.name, set->lab, keys::date_text(member.until_s));
  if (member.days_left(now_s) < kSoon_days) {
    return {"keys", Verdict::kAdvice, what,
            fmt::format("rm -r SET/{0} && rave keys add SET {0}", member.name)};
  }
  return {"keys", Verdict::kGood, what, {}};
}

}  // namespace rave::doctor
