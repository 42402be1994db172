// SPDX-License-Identifier: Apache-2.0
#include "rave/keys/key_set.hpp"
#include "scratch.hpp"

namespace rave::keys::testing {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

class ReadKeySet : public Scratch {
 protected:
  ReadKeySet() : made_(static_cast<bool>(make_key_set(plan()))) {}

  void SetUp() override { ASSERT_TRUE(made_); }

  /// What is wrong with `left`.
  [[nodiscard]] Texts problems() const {
    const auto info = read_key_set(folder_ / "set");
    return info ? info->members.front().problems : Texts{info.error().text()};
  }

  const fs::path left_ = folder_ / "set/left";
  const fs::path right_ = folder_ / "set/right";

 private:
  bool made_;
};

TEST_F(ReadKeySet, SaysWhoIsInItAndHowLong) {
  const auto info = read_key_set(folder_ / "set/");
  ASSERT_TRUE(info) << info.error().text();
  EXPECT_EQ(info->lab, "lab");
  EXPECT_EQ(info->authority.name, "authority");
  ASSERT_EQ(info->members.size(), 2U);
  EXPECT_EQ(info->members[0].name, "left");
  EXPECT_EQ(info->members[1].name, "right");
  EXPECT_EQ(info->members[0].from_s, kNow_s - kHeadStart_s);
  EXPECT_EQ(info->members[0].until_s, kNow_s + 365 * kDay_s);
  EXPECT_NE(info->members[0].fingerprint, info->members[1].fingerprint);
  EXPECT_TRUE(info->authority.problems.empty());
  EXPECT_EQ(problems(), Texts{});
}

TEST_F(ReadKeySet, TheFolderOfOneMemberIsReadToo) {
  fs::rename(left_, folder_ / "copied");
  const auto info = read_key_set(folder_ / "copied");
  ASSERT_TRUE(info) << info.error().text();
  ASSERT_EQ(info->members.size(), 1U);
  EXPECT_EQ(info->members[0].name, "left");
  EXPECT_EQ(info->members[0].problems, Texts{});
}

TEST_F(ReadKeySet, WhatIsMissingOrMixedUpIsNamed) {
  fs::copy_file(right_ / "identity_key.pem", left_ / "identity_key.pem",
                fs::copy_options::overwrite_existing);
  ASSERT_EQ(problems().size(), 1U);
  EXPECT_TRUE(problems()[0].starts_with("identity_key.pem: the certificate does not match the key"))
      << problems()[0];
  fs::remove(left_ / "permissions.p7s");
  EXPECT_EQ(problems(), Texts{"permissions.p7s is missing"});
  fs::copy_file(right_ / "permissions.p7s", left_ / "permissions.p7s");
  ASSERT_EQ(problems().size(), 2U);
  EXPECT_EQ(problems()[1], "permissions.p7s: it belongs to another member");
}

TEST_F(ReadKeySet, KeysOfAnotherMemberAreNamed) {
  fs::remove_all(left_);
  fs::copy(right_, left_);
  EXPECT_EQ(problems(), Texts{"they belong to `right`"});
}

TEST_F(ReadKeySet, ADamagedCertificateIsListedWithoutDates) {
  write(left_ / "identity.pem", "nothing");
  ASSERT_EQ(problems().size(), 1U);
  EXPECT_TRUE(problems()[0].starts_with("identity.pem: it is not a certificate")) << problems()[0];
}

TEST_F(ReadKeySet, AMemberOfAnotherSetIsNamed) {
  NewKeySet other = plan();
  other.folder = folder_ / "other";
  ASSERT_TRUE(make_key_set(other));
  fs::remove_all(left_);
  fs::rename(folder_ / "other/left", left_);
  const Texts found = problems();
  ASSERT_EQ(found.size(), 5U);
  EXPECT_TRUE(found[0].starts_with("identity.pem: the authority has not signed it")) << found[0];
  EXPECT_EQ(found[1], "identity_ca.pem: it differs from the authority of this set");
  EXPECT_TRUE(found[4].starts_with("permissions.p7s: it was not signed by the authority"))
      << found[4];
}

TEST_F(ReadKeySet, OpenKeysAreAProblem) {
  fs::permissions(left_ / "identity_key.pem", fs::perms{0644});
  EXPECT_EQ(problems(),
            Texts{"other users can read identity_key.pem (mode 0644); run `chmod 600` on it"});
  fs::permissions(folder_ / "set/ca/authority_key.pem", fs::perms{0640});
  EXPECT_EQ(read_key_set(folder_ / "set")->authority.problems.size(), 1U);
}

TEST_F(ReadKeySet, OtherFoldersAreNoMembers) {
  fs::create_directory(folder_ / "set/.git");
  fs::create_directory(folder_ / "set/notes");
  write(folder_ / "set/README", "ours");
  EXPECT_EQ(read_key_set(folder_ / "set")->members.size(), 2U);
}

TEST_F(ReadKeySet, NoKeysAtAll) {
  const auto none = read_key_set(folder_ / "nowhere");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  write(folder_ / "set/ca/authority.pem", "nothing");
  const auto damaged = read_key_set(folder_ / "set");
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().code, ErrorCode::kState);
  EXPECT_NE(damaged.error().message.find("authority.pem: it is not a certificate"),
            std::string::npos)
      << damaged.error().message;
}

TEST(DaysLeft, CountWholeOnes) {
  KeyInfo key;
  key.until_s = kNow_s;
  EXPECT_EQ(key.days_left(kNow_s - 2 * kDay_s), 2);
  EXPECT_EQ(key.days_left(kNow_s - 2 * kDay_s + 1), 1);
  EXPECT_EQ(key.days_left(kNow_s), 0);
  EXPECT_EQ(key.days_left(kNow_s + 1), -1);
  EXPECT_EQ(key.days_left(kNow_s + kDay_s), -1);
  EXPECT_EQ(key.days_left(kNow_s + kDay_s + 1), -2);
  EXPECT_EQ(date_text(kNow_s), "2027-01-15");
}

}  // namespace
}  // namespace rave::keys::testing
