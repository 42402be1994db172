// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

class People : public ::testing::Test {
 protected:
  [[nodiscard]] Ended people(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "people");
    arguments.insert(arguments.end(), {"--accounts", (folder_.path() / "gui").string()});
    return run_rave(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(People, AreInvitedListedAndUninvited) {
  const Ended invited =
      people({"invite", "--role", "commander", "--teams", "green", "--uses", "3"});
  EXPECT_EQ(invited.exit_code, 0) << invited.err;
  EXPECT_TRUE(invited.out.starts_with("/join?invite=")) << invited.out;
  EXPECT_NE(invited.out.find("for 3 people as commander, within 7 days"), std::string::npos);
  const std::string secret = invited.out.substr(13, 48);
  const Ended listed = people({"list"});
  EXPECT_NE(listed.out.find(": commander, teams green, 3 left"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find(secret), std::string::npos);
  EXPECT_EQ(content_of(folder_.path() / "gui/accounts").find(secret), std::string::npos);
  // A server leaves there where it is.
  std::ofstream(folder_.path() / "gui/address") << "https://lab.example:8080\n";
  EXPECT_TRUE(people({"invite"}).out.starts_with("https://lab.example:8080/join?invite="));
  EXPECT_EQ(people({"uninvite"}).out, "withdrew 2 invitations\n");
}

TEST_F(People, BadInput) {
  const auto error = [this](std::vector<std::string> arguments) {
    const Ended ended = people(std::move(arguments));
    EXPECT_EQ(ended.exit_code, 2);
    return ended.err;
  };
  EXPECT_EQ(error({"invite", "--role", "root"}),
            "rave: there is no role `root`; there are observer, commander and super_user\n");
  EXPECT_EQ(error({"invite", "--uses", "0"}),
            "rave: an invitation is valid for 1 to 1000 people\n");
  EXPECT_EQ(error({"remove", "ada"}), "rave: there is no account `ada`\n");
  EXPECT_NE(error({"add", "a b"}).find("a name has 1 to 32 letters"), std::string::npos);
  fs::permissions(folder_.path() / "gui", fs::perms(0755));
  EXPECT_NE(error({"list"}).find("chmod 700"), std::string::npos);
}

TEST_F(People, TheirCertificateIsMadeAndRenewed) {
  const std::string web = folder_.path() / "web";
  const Ended made = run_rave({"keys", "web", web, "lab.example", "192.168.1.20"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(
      made.out.starts_with("created " + web + " for lab.example, 192.168.1.20; valid until 2"))
      << made.out;
  EXPECT_NE(made.out.find("--certificate " + web + "/server.pem --key " + web + "/server_key.pem"),
            std::string::npos);
  const Ended again = run_rave({"keys", "web", web, "lab.example"});
  EXPECT_TRUE(again.out.starts_with("renewed in " + web)) << again.out << again.err;
  EXPECT_EQ((made.out + again.out).find("PRIVATE KEY"), std::string::npos);
  const Ended wrong = run_rave({"keys", "web", web, "bank.example", "--days", "500"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("500 days: expected 1 to 397"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace rave::cli_test
