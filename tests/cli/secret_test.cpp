// SPDX-License-Identifier: Apache-2.0
// A world over several processes that keep it to themselves.
#include <csignal>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

class Secret : public SharedWorld {};

TEST_F(Secret, ProcessesWithKeysOfASetShareAWorldAsWithout) {
  const std::string keys = folder("keys");
  ASSERT_EQ(run_rave({"keys", "new", keys, "env", "one", "two"}).exit_code, 0);
  const std::string alone = hash_alone("crowd.yaml", {});
  ASSERT_EQ(alone.size(), 16U);
  start("env", "env", "crowd.yaml", {"--security", keys + "/env"});
  for (const char* const host : {"one", "two"}) {
    start_host(host, "crowd.yaml", {"--security", keys + "/" + host});
  }
  for (const char* const who : {"env", "one", "two"}) EXPECT_EQ(end_of(who), 0) << console(who);
  EXPECT_EQ(result("env")["hash"], alone);
}

TEST_F(Secret, AHostWithoutKeysIsNotHeard) {
  const std::string keys = folder("keys");
  ASSERT_EQ(run_rave({"keys", "new", keys, "env", "one"}).exit_code, 0);
  start("env", "env", "crowd.yaml", {"--security", keys + "/env"});
  start_host("two", "crowd.yaml");
  start_host("one", "crowd.yaml", {"--security", keys + "/one"});
  wait_for_line("one", "waiting for two");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_NE(console("env").find("host `one` is here"), std::string::npos) << console("env");
  EXPECT_EQ(console("env").find("host `two` is here"), std::string::npos) << console("env");
}

TEST_F(Secret, ASetIsNoMember) {
  const std::string keys = folder("keys");
  ASSERT_EQ(run_rave({"keys", "new", keys, "env"}).exit_code, 0);
  const Ended ended = run_rave({"env", "crowd.yaml", "--security", keys});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "rave: security: there is no " + keys +
                           "/identity_ca.pem; this is a set of keys, name the folder of one "
                           "member in it\n");
}

}  // namespace
}  // namespace rave::cli_test
