// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <sys/stat.h>

#include <algorithm>

#include "certificate.hpp"
#include "layout.hpp"
#include "rave/base/file.hpp"
#include "rave/keys/key_set.hpp"

namespace rave::keys {
namespace {

namespace fs = std::filesystem;

constexpr auto kMemberFiles = {kIdentityCa,    kIdentity,   kIdentityKey,
                               kPermissionsCa, kGovernance, kPermissions};

KeyInfo info_of(const CertificateFacts& facts) {
  KeyInfo info;
  info.name = facts.name;
  info.from_s = facts.validity.from_s;
  info.until_s = facts.validity.until_s;
  info.fingerprint = facts.fingerprint;
  return info;
}

/// Checks that only the owner can read a private key: others could act in its name.
void check_mode(const fs::path& key, KeyInfo& info) {
  struct stat status {};
  if (::stat(key.c_str(), &status) != 0 || (status.st_mode & 077U) == 0) return;
  info.problems.push_back(
      fmt::format("other users can read {} (mode {:04o}); run `chmod 600` on it",
                  key.filename().string(), status.st_mode & 07777U));
}

/// Adds problems of a file to those of a member. All are collected instead of stopping at the
/// first: a set is repaired by copying it again, and one needs to know how much of it is wrong.
class MemberProblems {
 public:
  MemberProblems(fs::path folder, KeyInfo& info) : folder_(std::move(folder)), info_(&info) {}

  /// The content of a file; empty if it cannot be read.
  std::string read(const char* file) {
    auto content = read_file(folder_ / file, kLargestFile);
    if (content) return *std::move(content);
    add(file, content.error());
    return {};
  }
  void add(const char* file, const Error& error) {
    info_->problems.push_back(error.code == ErrorCode::kNotFound
                                  ? fmt::format("{} is missing", file)
                                  : fmt::format("{}: {}", file, error.message));
  }
  void add(const char* file, const Status& status) {
    if (!status) add(file, status.error());
  }

 private:
  fs::path folder_;
  KeyInfo* info_;
};

bool are_all_there(const fs::path& folder, KeyInfo& info) {
  std::error_code error;
  for (const char* const file : kMemberFiles) {
    if (!fs::is_regular_file(folder / file, error)) {
      info.problems.push_back(fmt::format("{} is missing", file));
    }
  }
  return info.problems.empty();
}

/// Checks that the documents are signed by the authority, and that the permissions are those of
/// this member.
void check_documents(const std::string& authority, const CertificateFacts& facts,
                     MemberProblems& problems) {
  const auto governance = signed_text(authority, problems.read(kGovernance));
  if (!governance) problems.add(kGovernance, governance.error());
  const auto permissions = signed_text(authority, problems.read(kPermissions));
  if (!permissions) {
    problems.add(kPermissions, permissions.error());
  } else if (permissions->find("<subject_name>" + facts.subject + "</subject_name>") ==
             std::string::npos) {
    problems.add(kPermissions, Error{ErrorCode::kState, "it belongs to another member", {}});
  }
}

/// Whether a folder is one of a member; others may lie beside them.
bool has_some(const fs::path& folder) {
  return std::ranges::any_of(kMemberFiles, [&](const char* file) {
    std::error_code error;
    return fs::exists(folder / file, error);
  });
}

KeyInfo read_member(const fs::path& folder, const std::string& authority) {
  KeyInfo info;
  info.name = without_slash(folder).filename();
  if (!are_all_there(folder, info)) return info;
  MemberProblems problems(folder, info);
  const std::string certificate = problems.read(kIdentity);
  const auto facts = read_certificate(certificate);
  if (!facts) {
    problems.add(kIdentity, facts.error());
    return info;
  }
  info = info_of(*facts);
  problems.add(kIdentity, check_issued(authority, certificate));
  for (const char* const file : {kIdentityCa, kPermissionsCa}) {
    if (problems.read(file) != authority) {
      problems.add(file, Error{ErrorCode::kState, "it differs from the authority of this set", {}});
    }
  }
  problems.add(kIdentityKey, check_pair({certificate, problems.read(kIdentityKey)}));
  check_documents(authority, *facts, problems);
  check_mode(folder / kIdentityKey, info);
  return info;
}

Result<KeyInfo> read_authority_info(const fs::path& file, const std::string& certificate,
                                    std::string& lab) {
  const auto facts = read_certificate(certificate);
  const Status whole = facts ? check_issued(certificate, certificate) : Status{};
  if (!facts || !whole) {
    return fail(ErrorCode::kState, "{}: {}", file.string(),
                facts ? whole.error().message : facts.error().message);
  }
  lab = facts->lab;
  KeyInfo info = info_of(*facts);
  info.name = "authority";
  return info;
}

/// The folders of members in a set, by name.
Result<std::vector<fs::path>> member_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (check_name(name) && has_some(entry->path())) folders.push_back(entry->path());
  }
  if (error) {
    return fail(ErrorCode::kIo, "cannot read `{}`: {}", folder.string(), error.message());
  }
  std::ranges::sort(folders);
  return folders;
}

}  // namespace

std::int64_t KeyInfo::days_left(std::int64_t now_s) const noexcept {
  const std::int64_t left_s = until_s - now_s;
  // Rounded down also for dates in the past: -1 from the first second after the end.
  return left_s >= 0 ? left_s / kDay_s : -1 - (-1 - left_s) / kDay_s;
}

Result<KeySetInfo> read_key_set(const fs::path& folder) {
  std::error_code error;
  const bool one = fs::is_regular_file(folder / kIdentity, error);
  if (!one) RAVE_TRY(check_set(folder));
  const fs::path file = one ? folder / kIdentityCa : folder / kCaFolder / kAuthority;
  RAVE_TRY_ASSIGN(const std::string certificate, read_file(file, kLargestFile));
  KeySetInfo info;
  RAVE_TRY_ASSIGN(info.authority, read_authority_info(file, certificate, info.lab));
  if (one) {
    info.members.push_back(read_member(folder, certificate));
    return info;
  }
  check_mode(folder / kCaFolder / kAuthorityKey, info.authority);
  RAVE_TRY_ASSIGN(const std::vector<fs::path> folders, member_folders(folder));
  for (const fs::path& member : folders) {
    info.members.push_back(read_member(member, certificate));
    KeyInfo& read = info.members.back();
    const std::string name = member.filename();
    if (read.name == name) continue;
    read.problems.push_back(fmt::format("they belong to `{}`", read.name));
    read.name = name;
  }
  return info;
}

std::string date_text(std::int64_t moment_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(moment_s));
}

}  // namespace rave::keys
