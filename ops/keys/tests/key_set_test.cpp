// SPDX-License-Identifier: Apache-2.0
#include "rave/keys/key_set.hpp"

#include "certificate.hpp"
#include "scratch.hpp"

namespace rave::keys::testing {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class KeySet : public Scratch {};

TEST_F(KeySet, HasTheFilesThatTheBusAsksFor) {
  ASSERT_TRUE(make_key_set(plan()));
  EXPECT_EQ(names_in(folder_), Names{"set"});
  EXPECT_EQ(names_in(folder_ / "set"), (Names{"ca", "left", "right"}));
  EXPECT_EQ(names_in(folder_ / "set/ca"), (Names{"authority.pem", "authority_key.pem"}));
  EXPECT_EQ(names_in(folder_ / "set/left"),
            (Names{"governance.p7s", "identity.pem", "identity_ca.pem", "identity_key.pem",
                   "permissions.p7s", "permissions_ca.pem"}));
}

TEST_F(KeySet, IsNobodyElsesBusiness) {
  ASSERT_TRUE(make_key_set(plan()));
  for (const char* const folder : {"set", "set/ca", "set/left", "set/right"}) {
    EXPECT_EQ(mode_of(folder_ / folder), 0700U) << folder;
  }
  for (const char* const key :
       {"ca/authority_key.pem", "left/identity_key.pem", "right/identity_key.pem"}) {
    EXPECT_EQ(mode_of(folder_ / "set" / key), 0600U) << key;
    EXPECT_TRUE(text_of(folder_ / "set" / key).starts_with("-----BEGIN PRIVATE KEY-----")) << key;
  }
}

TEST_F(KeySet, MembersHaveKeysOfTheirOwnAndTheSameAuthority) {
  ASSERT_TRUE(make_key_set(plan()));
  const fs::path left = folder_ / "set/left";
  const fs::path right = folder_ / "set/right";
  EXPECT_NE(text_of(left / "identity_key.pem"), text_of(right / "identity_key.pem"));
  EXPECT_EQ(text_of(left / "identity_ca.pem"), text_of(right / "permissions_ca.pem"));
  const auto permissions =
      signed_text(text_of(left / "permissions_ca.pem"), text_of(left / "permissions.p7s"));
  ASSERT_TRUE(permissions) << permissions.error().text();
  EXPECT_NE(permissions->find("CN=left,O=lab"), std::string::npos);
  EXPECT_EQ(permissions->find("right"), std::string::npos);
}

TEST_F(KeySet, NothingIsOverwritten) {
  ASSERT_TRUE(make_key_set(plan()));
  const std::string key = text_of(folder_ / "set/ca/authority_key.pem");
  const std::string set = (folder_ / "set").string();
  EXPECT_EQ(error_of(make_key_set(plan())), "`" + set +
                                                "` already exists, with keys for `left`, `right`; "
                                                "nothing was changed; `rave keys add " +
                                                set + " MEMBER` adds a member");
  EXPECT_EQ(text_of(folder_ / "set/ca/authority_key.pem"), key);

  NewKeySet other = plan();
  other.folder = folder_ / "empty";
  fs::create_directory(other.folder);
  EXPECT_EQ(
      error_of(make_key_set(other)),
      "`" + other.folder.string() + "` already exists; nothing was changed; choose another name");
  EXPECT_TRUE(fs::is_empty(other.folder));
}

TEST_F(KeySet, NamesAreChecked) {
  for (const std::string& good : Names{"a", "7", "left-2", "Left_Arm", std::string(64, 'x')}) {
    EXPECT_TRUE(check_name(good)) << good;
  }
  const std::string letters =
      "` cannot be a name: expected letters, digits, - and _, the first a letter or digit";
  for (const std::string& bad :
       Names{"le ft", "../left", "-left", ".left", "links\n", "gr\xc3\xbcn"}) {
    EXPECT_EQ(error_of(check_name(bad)), std::string("`").append(bad).append(letters));
  }
  EXPECT_EQ(error_of(check_name("")), "`` cannot be a name: expected 1 to 64 characters");
  EXPECT_NE(error_of(check_name(std::string(65, 'x'))), "none");
  EXPECT_EQ(error_of(check_name("ca")), "`ca` cannot be a name: it is the authority's folder");
}

TEST_F(KeySet, WhatCannotBeLeavesNothingBehind) {
  const auto attempt = [this](auto change) {
    NewKeySet set = plan();
    change(set);
    std::string error = error_of(make_key_set(set));
    EXPECT_TRUE(fs::is_empty(folder_)) << error;
    return error;
  };
  EXPECT_EQ(attempt([](NewKeySet& set) { set.members = {}; }),
            "no member given; each process or machine is a member");
  EXPECT_EQ(attempt([](NewKeySet& set) { set.members = {"a", "b", "a"}; }), "`a` is given twice");
  EXPECT_EQ(attempt([](NewKeySet& set) { set.days = 0; }), "0 days: expected 1 to 36500");
  EXPECT_EQ(attempt([](NewKeySet& set) { set.days = 36'501; }), "36501 days: expected 1 to 36500");
  EXPECT_NE(attempt([](NewKeySet& set) { set.lab = "a/b"; }).find("`a/b` cannot be a name"),
            std::string::npos);
  EXPECT_EQ(
      attempt([](NewKeySet& set) { set.folder = set.folder / "deep"; }),
      "cannot create a folder in `" + (folder_ / "set").string() + "`: No such file or directory");
}

TEST_F(KeySet, ASlashAtTheEndOfTheNameDoesNotMatter) {
  NewKeySet set = plan();
  set.folder += "/";
  ASSERT_TRUE(make_key_set(set));
  EXPECT_EQ(names_in(folder_), Names{"set"});
}

TEST_F(KeySet, MembersAreAddedByItsAuthority) {
  ASSERT_TRUE(make_key_set(plan()));
  const std::string left = text_of(folder_ / "set/left/identity.pem");
  const Status added = add_members(folder_ / "set", {"gui", "top"}, 0, kNow_s + kDay_s);
  ASSERT_TRUE(added) << added.error().text();
  EXPECT_EQ(names_in(folder_ / "set"), (Names{"ca", "gui", "left", "right", "top"}));
  EXPECT_EQ(text_of(folder_ / "set/left/identity.pem"), left);
  EXPECT_EQ(mode_of(folder_ / "set/gui/identity_key.pem"), 0600U);
  const auto info = read_key_set(folder_ / "set");
  ASSERT_TRUE(info);
  for (const KeyInfo& member : info->members) EXPECT_TRUE(member.problems.empty()) << member.name;
  // As long as the authority.
  EXPECT_EQ(info->members.front().name, "gui");
  EXPECT_EQ(info->members.front().until_s, info->authority.until_s);
}

TEST_F(KeySet, AddedMembersDoNotOutliveTheAuthority) {
  ASSERT_TRUE(make_key_set(plan()));
  ASSERT_TRUE(add_members(folder_ / "set", {"short"}, 10, kNow_s));
  ASSERT_TRUE(add_members(folder_ / "set", {"long"}, 1000, kNow_s));
  const auto info = read_key_set(folder_ / "set");
  ASSERT_TRUE(info);
  EXPECT_EQ(info->members[1].name, "long");
  EXPECT_EQ(info->members[1].until_s, kNow_s + 365 * kDay_s);
  EXPECT_EQ(info->members[3].name, "short");
  EXPECT_EQ(info->members[3].until_s, kNow_s + 10 * kDay_s);
}

TEST_F(KeySet, AllMembersAreAddedOrNone) {
  ASSERT_TRUE(make_key_set(plan()));
  const std::string right = (folder_ / "set/right").string();
  EXPECT_EQ(error_of(add_members(folder_ / "set", {"gui", "right"}, 0, kNow_s)),
            "`" + right +
                "` already exists; nothing was changed; to create a new certificate, remove the "
                "folder `" +
                right + "` first");
  EXPECT_EQ(names_in(folder_ / "set"), (Names{"ca", "left", "right"}));
}

TEST_F(KeySet, ASetThatIsNotThereHasANearName) {
  ASSERT_TRUE(make_key_set(plan()));
  EXPECT_EQ(error_of(add_members(folder_ / "sett", {"gui"}, 0, kNow_s)),
            "`" + (folder_ / "sett").string() +
                "` is not a set of keys: it has no ca/authority.pem; did you mean `set`?");
}

TEST_F(KeySet, AnExpiredAuthorityMakesNoMembers) {
  ASSERT_TRUE(make_key_set(plan()));
  EXPECT_EQ(error_of(add_members(folder_ / "set", {"gui"}, 0, kNow_s + 365 * kDay_s)),
            "the authority in `" + (folder_ / "set/ca").string() +
                "` expired on 2028-01-15; create a new set");
}

TEST_F(KeySet, ADamagedAuthorityMakesNoMembers) {
  const fs::path ca = folder_ / "set/ca";
  const auto add = [this] { return error_of(add_members(folder_ / "set", {"gui"}, 0, kNow_s)); };
  ASSERT_TRUE(make_key_set(plan()));
  const std::string certificate = text_of(ca / "authority.pem");
  const std::string key = text_of(ca / "authority_key.pem");

  write(ca / "authority.pem", text_of(folder_ / "set/left/identity.pem"));
  EXPECT_TRUE(add().find("authority.pem: the authority has not signed it") != std::string::npos)
      << add();
  // One letter of the base64 in the middle, which is the key or a date.
  std::string changed = certificate;
  char& letter = changed[changed.size() / 2];
  letter = letter == 'A' ? 'B' : 'A';
  write(ca / "authority.pem", changed);
  EXPECT_NE(add().find("expected the file that `rave keys new` created"), std::string::npos)
      << add();
  write(ca / "authority.pem", certificate);

  write(ca / "authority_key.pem", text_of(folder_ / "set/left/identity_key.pem"));
  EXPECT_NE(add().find("the certificate does not match the key"), std::string::npos) << add();
  write(ca / "authority_key.pem", "");
  EXPECT_NE(add().find("authority_key.pem: it is not a private key"), std::string::npos) << add();
  fs::remove(ca / "authority_key.pem");
  EXPECT_NE(add().find("authority_key.pem"), std::string::npos) << add();
  EXPECT_EQ(names_in(folder_ / "set"), (Names{"ca", "left", "right"}));

  write(ca / "authority_key.pem", key);
  fs::permissions(ca / "authority_key.pem", fs::perms(0644));
  EXPECT_NE(add().find("other users can read the private key"), std::string::npos) << add();
  fs::permissions(ca / "authority_key.pem", fs::perms(0600));
  EXPECT_EQ(add(), "none");
}

}  // namespace
}  // namespace rave::keys::testing
