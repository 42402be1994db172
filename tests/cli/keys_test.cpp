// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

class Keys : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
};

TEST_F(Keys, MadeAddedToAndShown) {
  const Ended made = run_rave({"keys", "new", path("lab-keys/"), "env", "left", "--name", "lab"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(
      made.out.starts_with("created " + path("lab-keys") + " for env, left; valid for 3650 "))
      << made.out;
  const Ended added = run_rave({"keys", "add", path("lab-keys"), "gui", "--days", "12"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_EQ(added.out, "added gui to " + path("lab-keys") + "\n");

  const Ended shown = run_rave({"keys", "show", path("lab-keys")});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_TRUE(shown.out.starts_with("lab lab\n")) << shown.out;
  for (const char* const name : {"\nauthority  2", "\nenv        2", "\ngui        2"}) {
    EXPECT_NE(shown.out.find(name), std::string::npos) << shown.out;
  }
  EXPECT_TRUE(shown.err.starts_with("warning: gui expires in 1")) << shown.err;
  for (const Ended& ended : {made, added, shown}) {
    EXPECT_EQ((ended.out + ended.err).find("PRIVATE KEY"), std::string::npos);
  }
}

TEST_F(Keys, MembersHaveThePublicKeyOfTickets) {
  ASSERT_EQ(run_rave({"keys", "new", path("set"), "left"}).exit_code, 0);
  ASSERT_EQ(run_rave({"keys", "add", path("set"), "right"}).exit_code, 0);
  const std::string open = content_of(path("set/line.key.pub"));
  EXPECT_TRUE(open.starts_with("rave-line-public ")) << open;
  EXPECT_EQ(content_of(path("set/left/line.pub")), open);
  EXPECT_EQ(content_of(path("set/right/line.pub")), open);
  const auto others = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(path("set/line.key")).permissions() & others, fs::perms::none);
  // A set that an older version made has no such key.
  for (const char* const file : {"set/line.key", "set/line.key.pub", "set/left/line.pub"}) {
    fs::remove(path(file));
  }
  ASSERT_EQ(run_rave({"keys", "add", path("set"), "gui"}).exit_code, 0);
  EXPECT_EQ(content_of(path("set/left/line.pub")), content_of(path("set/line.key.pub")));
}

TEST_F(Keys, AHostTakesTheKeyOfTicketsFromItsFolder) {
  ASSERT_EQ(run_rave({"keys", "new", path("set"), "left"}).exit_code, 0);
  std::ofstream(path("pair.yaml")) << "name: pair\nduration_s: 1\nprocesses: 2\nrobots:\n"
                                      "  - {name: a, pose: {x_m: 0, y_m: 0}, robot: {body: "
                                      "{shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}}\n"
                                      "  - {name: b, pose: {x_m: 2, y_m: 0}, robot: {body: "
                                      "{shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}}\n";
  const auto start = [this] {
    return run_rave({"robot", path("pair.yaml"), "--host", "host-1", "--web", "--security",
                     path("set/left"), "--output", path("out")});
  };
  std::ofstream(path("set/left/line.pub")) << "no key\n";
  const Ended wrong = start();
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("left/line.pub` is not a key of direct lines"), std::string::npos)
      << wrong.err;
  fs::remove(path("set/left/line.pub"));
  const Ended none = start();
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("--web needs --web-key FILE"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("left/line.pub` either"), std::string::npos) << none.err;
}

TEST_F(Keys, TroubleIsShownWithItsPlace) {
  ASSERT_EQ(run_rave({"keys", "new", path("set"), "left"}).exit_code, 0);
  fs::remove(path("set/left/permissions.p7s"));
  const Ended shown = run_rave({"keys", "show", path("set")});
  EXPECT_EQ(shown.exit_code, 1);
  EXPECT_EQ(shown.err, "rave: left: permissions.p7s is missing\n");
}

TEST_F(Keys, BadInput) {
  ASSERT_EQ(run_rave({"keys", "new", path("set"), "left"}).exit_code, 0);
  const Ended again = run_rave({"keys", "new", path("set"), "right"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("already exists, with keys for `left`"), std::string::npos) << again.err;
  const Ended near = run_rave({"keys", "show", path("sett")});
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_NE(near.err.find("did you mean `set`?"), std::string::npos) << near.err;
  const Ended typo = run_rave({"keys", "shwo", path("set")});
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_EQ(typo.err,
            "rave: there is no subcommand `keys shwo`; did you mean `show`?\n"
            "for usage: `rave keys --help`\n");
  const Ended nobody = run_rave({"keys", "new", path("other")});
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_FALSE(fs::exists(path("other")));
}

}  // namespace
}  // namespace rave::cli_test
