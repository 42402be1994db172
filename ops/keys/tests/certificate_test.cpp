// SPDX-License-Identifier: Apache-2.0
#include "certificate.hpp"

#include <gtest/gtest.h>

#include "documents.hpp"

namespace rave::keys {
namespace {

constexpr Validity kYear{1'800'000'000, 1'831'536'000};

class Certificates : public ::testing::Test {
 protected:
  Certificates()
      : authority_(make_authority("lab", kYear).value()),
        member_(make_member(authority_, "left", "lab", kYear).value()) {}

  const Credential authority_;
  const Credential member_;
};

TEST_F(Certificates, SayWhoseTheyAre) {
  const auto facts = read_certificate(member_.certificate);
  ASSERT_TRUE(facts) << facts.error().text();
  EXPECT_EQ(facts->name, "left");
  EXPECT_EQ(facts->lab, "lab");
  EXPECT_EQ(facts->subject, "CN=left,O=lab");
  EXPECT_EQ(facts->validity.from_s, kYear.from_s);
  EXPECT_EQ(facts->validity.until_s, kYear.until_s);
  EXPECT_EQ(facts->fingerprint.size(), 32U * 3 - 1);
  EXPECT_FALSE(facts->authority);
  const auto above = read_certificate(authority_.certificate);
  ASSERT_TRUE(above);
  EXPECT_TRUE(above->authority);
  EXPECT_EQ(above->subject, "CN=RAVE authority,O=lab");
  EXPECT_NE(above->fingerprint, facts->fingerprint);
}

TEST_F(Certificates, DatesBehind2050KeepTheirCentury) {
  const Validity far{4'000'000'000, 4'900'000'000};
  const auto late = make_authority("lab", far);
  ASSERT_TRUE(late);
  const auto facts = read_certificate(late->certificate);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->validity.from_s, far.from_s);
  EXPECT_EQ(facts->validity.until_s, far.until_s);
}

TEST_F(Certificates, OnlyTheAuthorityHasSignedThem) {
  EXPECT_TRUE(check_issued(authority_.certificate, member_.certificate));
  EXPECT_TRUE(check_issued(authority_.certificate, authority_.certificate));
  const auto other = make_authority("lab", kYear);
  ASSERT_TRUE(other);
  const Status foreign = check_issued(other->certificate, member_.certificate);
  ASSERT_FALSE(foreign);
  EXPECT_EQ(foreign.error().code, ErrorCode::kState);
  EXPECT_TRUE(foreign.error().message.starts_with("the authority has not signed it"))
      << foreign.error().message;
}

TEST_F(Certificates, KeysBelongToOne) {
  EXPECT_TRUE(check_pair(authority_));
  EXPECT_TRUE(check_pair(member_));
  const Status mixed = check_pair({authority_.certificate, member_.key});
  ASSERT_FALSE(mixed);
  EXPECT_TRUE(mixed.error().message.starts_with("the certificate does not match the key"));
  const Status none = check_pair({authority_.certificate, "-----BEGIN PRIVATE KEY-----\n"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kParse);
}

TEST_F(Certificates, NoTwoKeysAreTheSame) {
  const auto again = make_member(authority_, "left", "lab", kYear);
  ASSERT_TRUE(again);
  EXPECT_NE(again->key, member_.key);
  EXPECT_NE(again->certificate, member_.certificate);
}

TEST_F(Certificates, SignaturesHoldForTheVeryTextAndSigner) {
  const std::string text = governance_xml();
  const auto document = sign(authority_, text);
  ASSERT_TRUE(document) << document.error().text();
  const auto back = signed_text(authority_.certificate, *document);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_NE(back->find("<allow_unauthenticated_participants>false<"), std::string::npos);

  std::string changed = *document;
  const std::size_t place = changed.find("false</allow_unauthenticated");
  ASSERT_NE(place, std::string::npos);
  changed.replace(place, 5, "true ");
  EXPECT_EQ(signed_text(authority_.certificate, changed).error().code, ErrorCode::kState);

  // A member can sign, but nobody takes it for the authority.
  const auto forged = sign(member_, text);
  ASSERT_TRUE(forged);
  EXPECT_EQ(signed_text(authority_.certificate, *forged).error().code, ErrorCode::kState);
  EXPECT_EQ(signed_text(authority_.certificate, "nothing").error().code, ErrorCode::kParse);
}

TEST_F(Certificates, ADigestThatNobodyKnowsIsNamed) {
  std::string document = *sign(authority_, governance_xml());
  // In base64 the end of the number of SHA-256, in the list of digests: one bit of it.
  const std::size_t place = document.find("ZQMEAgEFADAL");
  ASSERT_NE(place, std::string::npos);
  document[place + 2] = 'm';
  const auto back = signed_text(authority_.certificate, document);
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().text().find("SHA-256"), std::string::npos) << back.error().text();
}

TEST_F(Certificates, TextsThatAreNone) {
  for (const char* const text : {"", "left", "-----BEGIN CERTIFICATE-----\nAAAA\n"}) {
    const auto facts = read_certificate(text);
    ASSERT_FALSE(facts) << text;
    EXPECT_TRUE(facts.error().message.starts_with("it is not a certificate: "))
        << facts.error().message;
  }
}

TEST(Documents, PermissionsNameTheMemberAndItsDates) {
  const std::string text = permissions_xml("left", "CN=left,O=lab", {1'800'000'000, 1'800'000'001});
  for (const char* const part :
       {"<subject_name>CN=left,O=lab</subject_name>", "<not_before>2027-01-15T08:00:00<",
        "<not_after>2027-01-15T08:00:01<", "<topic>rave/*</topic>", "<partition>rave/*</partition>",
        "<topic>rt/*</topic>", "<default>DENY</default>"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace rave::keys
