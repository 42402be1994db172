// SPDX-License-Identifier: Apache-2.0
#include "rave/keys/key_set.hpp"

#include <algorithm>
#include <span>

#include "certificate.hpp"
#include "documents.hpp"
#include "layout.hpp"
#include "private_files.hpp"
#include "rave/base/file.hpp"
#include "rave/base/plain_name.hpp"

namespace rave::keys {
namespace {

namespace fs = std::filesystem;

constexpr ErrorCode kBad = ErrorCode::kInvalidArgument;
constexpr std::size_t kLongestName = 64;

Status check_members(const std::vector<std::string>& members) {
  if (members.empty()) return fail(kBad, "no member given; each process or machine is a member");
  for (auto member = members.begin(); member != members.end(); ++member) {
    RAVE_TRY(check_name(*member));
    if (std::find(members.begin(), member, *member) != member) {
      return fail(kBad, "`{}` is given twice", *member);
    }
  }
  return {};
}

Status check_days(int days, int least) {
  if (days >= least && days <= kMostDays) return {};
  return fail(kBad, "{} days: expected {} to {}", days, least, kMostDays);
}

/// The authority of a set with its key and documents.
struct Authority {
  Credential credential;
  CertificateFacts facts;
  std::string governance;  ///< Signed; the same for all members.
};

Result<Authority> new_authority(const std::string& lab, const Validity& validity) {
  Authority authority;
  RAVE_TRY_ASSIGN(authority.credential, make_authority(lab, validity));
  RAVE_TRY_ASSIGN(authority.facts, read_certificate(authority.credential.certificate));
  RAVE_TRY_ASSIGN(authority.governance, sign(authority.credential, governance_xml()));
  return authority;
}

/// Makes the folder of a member.
Status make_member_folder(const fs::path& folder, const Authority& authority,
                          const std::string& name, const Validity& validity) {
  const Credential& signer = authority.credential;
  RAVE_TRY_ASSIGN(const Credential member,
                  make_member(signer, name, authority.facts.lab, validity));
  RAVE_TRY_ASSIGN(const CertificateFacts facts, read_certificate(member.certificate));
  RAVE_TRY_ASSIGN(const std::string permissions,
                  sign(signer, permissions_xml(name, facts.subject, validity)));
  RAVE_TRY(make_private_folder(folder));
  // DDS Security has two authorities, for identities and for permissions. Here both are the same.
  RAVE_TRY(write_private_file(folder / kIdentityCa, signer.certificate));
  RAVE_TRY(write_private_file(folder / kIdentity, member.certificate));
  RAVE_TRY(write_private_file(folder / kIdentityKey, member.key));
  RAVE_TRY(write_private_file(folder / kPermissionsCa, signer.certificate));
  RAVE_TRY(write_private_file(folder / kGovernance, authority.governance));
  return write_private_file(folder / kPermissions, permissions);
}

/// The error for a set whose name is taken.
tl::unexpected<Error> taken(const fs::path& folder) {
  const auto there = read_key_set(folder);
  if (!there || !check_set(folder)) {
    return fail(kBad, "`{}` already exists; nothing was changed; choose another name",
                folder.string());
  }
  std::string names;
  for (const KeyInfo& member : there->members) {
    names += (names.empty() ? "`" : ", `") + member.name + "`";
  }
  return fail(kBad,
              "`{0}` already exists, with keys for {1}; nothing was changed; `rave keys add {0} "
              "MEMBER` adds a member",
              folder.string(), names.empty() ? "no members" : names);
}

/// Reads the authority of a set and checks that it can create members.
Result<Authority> read_authority(const fs::path& folder, std::int64_t now_s) {
  RAVE_TRY(check_set(folder));
  const fs::path ca = folder / kCaFolder;
  Authority authority;
  RAVE_TRY_ASSIGN(authority.credential.certificate, read_file(ca / kAuthority, kLargestFile));
  const auto damaged = [&](const char* file, Error error) {
    return fail(ErrorCode::kState, "{}: {}; expected the file that `rave keys new` created",
                (ca / file).string(), error.message);
  };
  auto facts = read_certificate(authority.credential.certificate);
  if (!facts) return damaged(kAuthority, facts.error());
  authority.facts = *std::move(facts);
  // The authority signs itself, so a change of one bit of its certificate shows here.
  const Status whole =
      check_issued(authority.credential.certificate, authority.credential.certificate);
  if (!whole) return damaged(kAuthority, whole.error());
  if (!authority.facts.authority || !check_name(authority.facts.lab)) {
    return fail(ErrorCode::kState, "{}: not the certificate of a RAVE authority",
                (ca / kAuthority).string());
  }
  if (authority.facts.validity.until_s <= now_s) {
    return fail(ErrorCode::kState, "the authority in `{}` expired on {}; create a new set",
                ca.string(), date_text(authority.facts.validity.until_s));
  }
  RAVE_TRY(check_private_file(ca / kAuthorityKey));
  RAVE_TRY_ASSIGN(authority.credential.key, read_file(ca / kAuthorityKey, kLargestFile));
  const Status pair = check_pair(authority.credential);
  if (!pair) return damaged(kAuthorityKey, pair.error());
  RAVE_TRY_ASSIGN(authority.governance, sign(authority.credential, governance_xml()));
  return authority;
}

/// Removes the members that were moved already when a later one fails.
void remove_folders(const fs::path& folder, std::span<const std::string> names) {
  std::error_code ignored;
  for (const std::string& name : names) fs::remove_all(folder / name, ignored);
}

}  // namespace

Status check_name(std::string_view name) {
  if (name.empty() || name.size() > kLongestName) {
    return fail(kBad, "`{}` cannot be a name: expected 1 to {} characters", name, kLongestName);
  }
  if (!is_plain_name(name, "-_") || !is_plain(name.front(), "")) {
    return fail(kBad,
                "`{}` cannot be a name: expected letters, digits, - and _, the first a letter or "
                "digit",
                name);
  }
  if (name == kCaFolder) return fail(kBad, "`ca` cannot be a name: it is the authority's folder");
  return {};
}

Status make_key_set(const NewKeySet& set) {
  RAVE_TRY(check_name(set.lab));
  RAVE_TRY(check_days(set.days, 1));
  RAVE_TRY(check_members(set.members));
  const fs::path folder = without_slash(set.folder);
  if (is_taken(folder)) return taken(folder);
  const Validity validity{set.now_s - kHeadStart_s, set.now_s + set.days * kDay_s};
  // Made in a hidden folder beside its place and moved there when it is complete. An error on the
  // way leaves nothing, and no half set is ever taken for one. On the same file system the move is
  // atomic.
  RAVE_TRY_ASSIGN(const ScratchFolder scratch, ScratchFolder::inside(parent_of(folder)));
  const fs::path whole = scratch.path() / "set";
  RAVE_TRY(make_private_folder(whole));
  RAVE_TRY(make_private_folder(whole / kCaFolder));
  RAVE_TRY_ASSIGN(const Authority authority, new_authority(set.lab, validity));
  RAVE_TRY(write_private_file(whole / kCaFolder / kAuthority, authority.credential.certificate));
  RAVE_TRY(write_private_file(whole / kCaFolder / kAuthorityKey, authority.credential.key));
  for (const std::string& member : set.members) {
    RAVE_TRY(make_member_folder(whole / member, authority, member, validity));
  }
  return move_to_free_name(whole, folder);
}

Status add_members(const fs::path& folder, const std::vector<std::string>& members, int days,
                   std::int64_t now_s) {
  RAVE_TRY(check_days(days, 0));
  RAVE_TRY(check_members(members));
  RAVE_TRY_ASSIGN(const Authority authority, read_authority(folder, now_s));
  for (const std::string& member : members) {
    if (is_taken(folder / member)) {
      return fail(kBad,
                  "`{0}` already exists; nothing was changed; to create a new certificate, remove "
                  "the folder `{0}` first",
                  (folder / member).string());
    }
  }
  Validity validity = authority.facts.validity;
  // A member must not be valid while its authority is not.
  validity.from_s = std::max(validity.from_s, now_s - kHeadStart_s);
  if (days > 0) validity.until_s = std::min(validity.until_s, now_s + days * kDay_s);
  RAVE_TRY_ASSIGN(const ScratchFolder scratch, ScratchFolder::inside(folder));
  for (const std::string& member : members) {
    RAVE_TRY(make_member_folder(scratch.path() / member, authority, member, validity));
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    Status moved = move_to_free_name(scratch.path() / members[i], folder / members[i]);
    if (moved) continue;
    remove_folders(folder, std::span(members).first(i));
    return moved;
  }
  return {};
}

}  // namespace rave::keys
