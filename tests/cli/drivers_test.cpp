// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

TEST(Drivers, ListByKind) {
  const Ended all = run_rave({"drivers"});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_NE(all.out.find("wander"), std::string::npos);
  EXPECT_NE(all.out.find("virtual_laser"), std::string::npos);
  const Ended some = run_rave({"drivers", "--kind", "program"});
  EXPECT_NE(some.out.find("wander"), std::string::npos);
  EXPECT_EQ(some.out.find("virtual_laser"), std::string::npos);
  EXPECT_EQ(run_rave({"drivers", "--kind", "virtul_sensor"}).err,
            "rave: there is no kind of driver `virtul_sensor`; did you mean `virtual sensor`?\n");
}

TEST(Drivers, MissingFolder) {
  const Ended ended = run_rave({"drivers", "--plugins", "nowhere"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "rave: --plugins: there is no plug-in folder `nowhere`\n");
  EXPECT_EQ(run_rave({"drivers"}, {"RAVE_PLUGIN_PATH=nowhere"}).err,
            "rave: RAVE_PLUGIN_PATH: there is no plug-in folder `nowhere`\n");
}

// A driver that is dropped into a folder can be used; a file that is none is named with the reason.
TEST(Drivers, FoldersOfOnesOwn) {
  const TemporaryFolder folder;
  fs::copy_file(RAVE_BINARY_DIR "/lib/rave/plugins/virtual_sonar.so",
                folder.path() / "dropped_in.so");
  std::ofstream(folder.path() / "broken.so") << "not a library";
  for (const Ended& ended :
       {run_rave({"drivers", "--plugins", folder.path()}),
        run_rave({"drivers"}, {"RAVE_PLUGIN_PATH=" + folder.path().string()})}) {
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_NE(ended.out.find("dropped_in.so"), std::string::npos) << ended.out;
    EXPECT_NE(ended.err.find("not usable:"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("broken.so"), std::string::npos) << ended.err;
  }
}

TEST(Describe, PageAndUnknownName) {
  const Ended page = run_rave({"describe", "virtual_laser"});
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_NE(page.out.find("range_max_m"), std::string::npos);
  EXPECT_NE(page.out.find("  gives    ranges (C++ type float)\n"), std::string::npos) << page.out;
  EXPECT_NE(run_rave({"describe", "velocity"}).out.find("  accepts  velocity\n"),
            std::string::npos);
  const std::string json = run_rave({"describe", "virtual_contact", "--json"}).out;
  EXPECT_NE(json.find("\"gives\": \"contact\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"record_type\": \"ContactReading\""), std::string::npos) << json;
  const Ended none = run_rave({"describe", "virtul_laser"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err.substr(0, none.err.find(" (`rave drivers` lists all)")),
            "rave: there is no driver or program `virtul_laser`; did you mean `virtual_laser`?");
  EXPECT_EQ(run_rave({"describe", "wander", "--json"}).out.substr(0, 1), "[");
}

TEST(Reference, CommittedPageIsUpToDate) {
  EXPECT_EQ(run_rave({"drivers", "--markdown-reference"}).out,
            content_of(RAVE_SOURCE_DIR "/docs/reference/drivers.md"))
      << "run tools/reference.sh and commit what it writes";
}

}  // namespace
}  // namespace rave::cli_test
