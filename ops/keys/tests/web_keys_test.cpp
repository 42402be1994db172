// SPDX-License-Identifier: Apache-2.0
#include "rave/keys/web_keys.hpp"

#include "certificate.hpp"
#include "scratch.hpp"

namespace rave::keys::testing {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class WebKeysTest : public Scratch {
 protected:
  [[nodiscard]] NewWebKeys wanted(Names names = {"lab.example", "192.168.1.20"}) const {
    return {folder_ / "web", std::move(names), kMostWebDays, kNow_s};
  }
  [[nodiscard]] static std::string error_of(const Result<WebKeys>& made) {
    return made ? "none" : made.error().message;
  }
};

TEST_F(WebKeysTest, HasAnAuthorityOfItsOwnAndAServer) {
  const auto made = make_web_keys(wanted());
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_TRUE(made->new_authority);
  EXPECT_EQ(names_in(folder_), Names{"web"});
  EXPECT_EQ(names_in(folder_ / "web"),
            (Names{"authority.pem", "authority_key.pem", "server.pem", "server_key.pem"}));
  EXPECT_EQ(mode_of(folder_ / "web"), 0700U);
  EXPECT_EQ(mode_of(folder_ / "web/authority_key.pem"), 0600U);
  EXPECT_EQ(mode_of(folder_ / "web/server_key.pem"), 0600U);
  const auto server = read_certificate(text_of(folder_ / "web/server.pem"));
  ASSERT_TRUE(server);
  EXPECT_FALSE(server->authority);
  EXPECT_LE(server->validity.until_s - server->validity.from_s, 397 * kDay_s);
  EXPECT_TRUE(check_web_server(text_of(folder_ / "web/authority.pem"),
                               text_of(folder_ / "web/server.pem"), kNow_s));
}

TEST_F(WebKeysTest, TheAuthoritySpeaksForItsNamesAlone) {
  ASSERT_TRUE(make_web_keys(wanted()));
  const Credential authority{text_of(folder_ / "web/authority.pem"),
                             text_of(folder_ / "web/authority_key.pem")};
  const Validity validity{kNow_s - kDay_s, kNow_s + kDay_s};
  for (const Names& foreign : {Names{"bank.example"}, Names{"10.0.0.1"}, Names{"::1"}}) {
    const auto forged = make_web_server(authority, foreign, validity);
    ASSERT_TRUE(forged);
    const Status taken = check_web_server(authority.certificate, forged->certificate, kNow_s);
    ASSERT_FALSE(taken) << foreign.front();
    EXPECT_NE(taken.error().message.find("permitted subtree violation"), std::string::npos)
        << taken.error().message;
  }
}

TEST_F(WebKeysTest, OfAddressesAloneAndOfNamesAlone) {
  NewWebKeys addresses = wanted({"127.0.0.1", "::1"});
  ASSERT_TRUE(make_web_keys(addresses));
  const Credential authority{text_of(folder_ / "web/authority.pem"),
                             text_of(folder_ / "web/authority_key.pem")};
  const auto forged = make_web_server(authority, {"bank.example"}, {kNow_s - 1, kNow_s + kDay_s});
  ASSERT_TRUE(forged);
  EXPECT_FALSE(check_web_server(authority.certificate, forged->certificate, kNow_s));
  NewWebKeys names = wanted({"lab.example"});
  names.folder = folder_ / "names";
  EXPECT_EQ(error_of(make_web_keys(names)), "none");
}

TEST_F(WebKeysTest, IsRenewedUnderTheSameAuthority) {
  ASSERT_TRUE(make_web_keys(wanted()));
  const std::string authority = text_of(folder_ / "web/authority.pem");
  const std::string server = text_of(folder_ / "web/server.pem");
  NewWebKeys again = wanted();
  again.now_s += 300 * kDay_s;
  const auto made = make_web_keys(again);
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_FALSE(made->new_authority);
  EXPECT_EQ(text_of(folder_ / "web/authority.pem"), authority);
  EXPECT_NE(text_of(folder_ / "web/server.pem"), server);
  EXPECT_EQ(mode_of(folder_ / "web/server_key.pem"), 0600U);
  EXPECT_TRUE(
      check_pair({text_of(folder_ / "web/server.pem"), text_of(folder_ / "web/server_key.pem")}));
}

TEST_F(WebKeysTest, OtherNamesNeedAnotherAuthority) {
  ASSERT_TRUE(make_web_keys(wanted()));
  const std::string server = text_of(folder_ / "web/server.pem");
  const std::string error = error_of(make_web_keys(wanted({"other.example"})));
  EXPECT_NE(error.find("is not permitted to certify these names"), std::string::npos) << error;
  EXPECT_EQ(text_of(folder_ / "web/server.pem"), server);
}

TEST_F(WebKeysTest, WhatCannotBeIsRefused) {
  const auto refused = [this](const std::string& name) {
    return error_of(make_web_keys(wanted({name})));
  };
  for (const std::string& bad :
       Names{"", "*.example", "a b", "a,DNS:bank.example", "-a", "a..b", "a.", "ä", "1.2.3.4/8"}) {
    EXPECT_EQ(refused(bad), "`" + bad + "` is neither a host name nor an address");
  }
  NewWebKeys long_one = wanted();
  long_one.days = 398;
  EXPECT_EQ(error_of(make_web_keys(long_one)),
            "398 days: expected 1 to 397, because browsers refuse longer validity");
  EXPECT_NE(error_of(make_web_keys(wanted({}))).find("expected 1 to 50 names"), std::string::npos);
  // The set with which processes talk is something else.
  ASSERT_TRUE(make_key_set(plan()));
  NewWebKeys inside = wanted();
  inside.folder = folder_ / "set";
  EXPECT_NE(error_of(make_web_keys(inside)).find("has no authority_key.pem"), std::string::npos);
  EXPECT_EQ(names_in(folder_), Names{"set"});
}

TEST_F(WebKeysTest, AnExpiredAuthoritySignsNothing) {
  ASSERT_TRUE(make_web_keys(wanted()));
  NewWebKeys late = wanted();
  late.now_s += 4000 * kDay_s;
  EXPECT_NE(error_of(make_web_keys(late)).find("expired on"), std::string::npos);
}

}  // namespace
}  // namespace rave::keys::testing
