// SPDX-License-Identifier: Apache-2.0
// `rave doctor` on this machine; between machines: tests/machines.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.hpp"

namespace rave::cli_test {
namespace {

using Json = nlohmann::json;

Json finding(const Json& document, const std::string& check) {
  for (const Json& finding : document.value("findings", Json::array())) {
    if (finding["check"] == check) return finding;
  }
  return {{"verdict", "not there"}};
}

TEST(Doctor, OneMachineAlone) {
  const Ended ended = run_rave({"doctor", "--json", "--bus-tag", "doctor-test", "--domain", "37"});
  const Json json = Json::parse(ended.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << ended.out << ended.err;
  EXPECT_EQ(json["rave_doctor"], 1);
  EXPECT_EQ(ended.exit_code, json["well"] == true ? 0 : 1);
  for (const char* const check : {"kernel", "interface", "ports", "keys", "clock", "bus"}) {
    EXPECT_EQ(finding(json, check)["verdict"], "good") << ended.out;
  }
}

TEST(Doctor, EachProblemHasTheCommandThatMendsIt) {
  const Ended ended =
      run_rave({"doctor", "--interface", "eth99", "--peer", "192.0.2.1", "--security", "nowhere"},
               {"CYCLONEDDS_URI=file:///nowhere.xml"});
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  for (const char* const text :
       {"there is no interface `eth99`", "--interface ", "CYCLONEDDS_URI names /nowhere.xml",
        "unset CYCLONEDDS_URI", "rave keys show nowhere",
        "the line below each one says how to fix it"}) {
    EXPECT_NE(ended.out.find(text), std::string::npos) << text << "\n" << ended.out;
  }
}

TEST(Doctor, LoopbackLeadsToNobody) {
  const Ended ended = run_rave({"doctor", "--peer", "192.0.2.1"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.out.find("lo reaches only this machine"), std::string::npos) << ended.out;
}

TEST(Doctor, BadInput) {
  const Ended ended = run_rave({"doctor", "--multicast", "dat"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "rave: --multicast: found `dat`; did you mean `data`?\n");
  const Ended listen = run_rave({"doctor", "--listen", "--interface", "eth99"});
  EXPECT_EQ(listen.exit_code, 2);
  EXPECT_NE(listen.err.find("there is no interface `eth99`"), std::string::npos) << listen.err;
}

}  // namespace
}  // namespace rave::cli_test
