// SPDX-License-Identifier: Apache-2.0
#include "rave/keys/web_keys.hpp"

#include "certificate.hpp"
#include "layout.hpp"
#include "private_files.hpp"
#include "rave/base/file.hpp"
#include "rave/base/plain_name.hpp"
#include "rave/keys/key_set.hpp"
#include "web_names.hpp"

namespace rave::keys {
namespace {

namespace fs = std::filesystem;

constexpr ErrorCode kBadWeb = ErrorCode::kInvalidArgument;
constexpr std::size_t kMostNames = 50;
/// The authority is valid for ten years, so that people add it to their browsers only once.
constexpr std::int64_t kAuthorityDays = 3650;
/// Validity before the creation, for machines whose clock is slow; counts as part of the days.
constexpr std::int64_t kEarly_s = 3600;

constexpr const char* kServer = "server.pem";
constexpr const char* kServerKey = "server_key.pem";

bool is_label(std::string_view label) {
  return is_plain_name(label, "-") && label.size() <= 63 && label.front() != '-' &&
         label.back() != '-';
}

Status check(const NewWebKeys& wanted) {
  if (wanted.names.empty() || wanted.names.size() > kMostNames) {
    return fail(kBadWeb, "expected 1 to {} names, such as lab.example or 192.168.1.20", kMostNames);
  }
  for (const std::string& name : wanted.names) RAVE_TRY(check_web_name(name));
  if (wanted.days < 1 || wanted.days > kMostWebDays) {
    return fail(kBadWeb, "{} days: expected 1 to {}, because browsers refuse longer validity",
                wanted.days, kMostWebDays);
  }
  return {};
}

Result<Credential> read_web_authority(const fs::path& folder, std::int64_t now_s) {
  Credential authority;
  RAVE_TRY_ASSIGN(authority.certificate, read_file(folder / kAuthority, kLargestFile));
  RAVE_TRY(check_private_file(folder / kAuthorityKey));
  RAVE_TRY_ASSIGN(authority.key, read_file(folder / kAuthorityKey, kLargestFile));
  RAVE_TRY(check_pair(authority));
  RAVE_TRY_ASSIGN(const CertificateFacts facts, read_certificate(authority.certificate));
  if (facts.validity.until_s <= now_s) {
    return fail(ErrorCode::kState, "the authority in `{}` expired on {}; create another folder",
                folder.string(), date_text(facts.validity.until_s));
  }
  return authority;
}

// A running server may read the file at this moment, so the new file replaces the old one in one
// step.
Status replace_file(const fs::path& file, const std::string& content) {
  fs::path part = file;
  part += ".part";
  std::error_code error;
  fs::remove(part, error);
  RAVE_TRY(write_private_file(part, content));
  fs::rename(part, file, error);
  if (error) return fail(ErrorCode::kIo, "cannot write `{}`: {}", file.string(), error.message());
  return {};
}

Validity server_validity(const NewWebKeys& wanted) {
  const std::int64_t from_s = wanted.now_s - kEarly_s;
  return {from_s, from_s + wanted.days * kDay_s};
}

Status renew(const NewWebKeys& wanted, const fs::path& folder, const Credential& authority) {
  RAVE_TRY_ASSIGN(const Credential server,
                  make_web_server(authority, wanted.names, server_validity(wanted)));
  // An older authority may be constrained to other names. Browsers would refuse the new
  // certificate, so it is an error here.
  const Status good = check_web_server(authority.certificate, server.certificate, wanted.now_s);
  if (!good) {
    return fail(ErrorCode::kState,
                "the authority in `{}` is not permitted to certify these names ({}); nothing was "
                "changed; create another folder",
                folder.string(), good.error().message);
  }
  // Two files cannot be replaced in one step. Between the two the pair does not match.
  RAVE_TRY(replace_file(folder / kServerKey, server.key));
  return replace_file(folder / kServer, server.certificate);
}

Status make_new(const NewWebKeys& wanted, const fs::path& folder, Credential& authority) {
  const Validity validity{wanted.now_s - kEarly_s, wanted.now_s + kAuthorityDays * kDay_s};
  RAVE_TRY_ASSIGN(authority, make_web_authority(wanted.names, validity));
  RAVE_TRY_ASSIGN(const ScratchFolder scratch, ScratchFolder::inside(parent_of(folder)));
  const fs::path whole = scratch.path() / "web";
  RAVE_TRY(make_private_folder(whole));
  RAVE_TRY(write_private_file(whole / kAuthority, authority.certificate));
  RAVE_TRY(write_private_file(whole / kAuthorityKey, authority.key));
  RAVE_TRY(renew(wanted, whole, authority));
  return move_to_free_name(whole, folder);
}

}  // namespace

Status check_web_name(std::string_view name) {
  if (is_ipv4(std::string(name)) || is_ipv6(std::string(name))) return {};
  std::string_view rest = name;
  bool good = !name.empty() && name.size() <= 253;
  while (good) {
    const std::string_view label = rest.substr(0, rest.find('.'));
    good = is_label(label);
    if (label.size() == rest.size()) break;
    rest.remove_prefix(label.size() + 1);
  }
  if (good) return {};
  return fail(kBadWeb, "`{}` is neither a host name nor an address", name);
}

Result<WebKeys> make_web_keys(const NewWebKeys& wanted) {
  RAVE_TRY(check(wanted));
  const fs::path folder = without_slash(wanted.folder);
  WebKeys made;
  Credential authority;
  std::error_code error;
  if (is_taken(folder)) {
    if (!fs::is_regular_file(folder / kAuthorityKey, error)) {
      return fail(kBadWeb, "`{}` already exists and has no {}; choose another name",
                  folder.string(), kAuthorityKey);
    }
    RAVE_TRY_ASSIGN(authority, read_web_authority(folder, wanted.now_s));
    RAVE_TRY(renew(wanted, folder, authority));
  } else {
    made.new_authority = true;
    RAVE_TRY(make_new(wanted, folder, authority));
  }
  RAVE_TRY_ASSIGN(const CertificateFacts facts, read_certificate(authority.certificate));
  made.fingerprint = facts.fingerprint;
  made.until_s = server_validity(wanted).until_s;
  return made;
}

}  // namespace rave::keys
