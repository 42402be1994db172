// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "programs/testing/program_harness.hpp"

namespace rave {
namespace {

using testing::ProgramUnderTest;
using testing::Rig;

constexpr float kFree = std::numeric_limits<float>::infinity();

/// One robot whose program is the text of a test, with three rays at -90, 0 and 90 degrees.
class LuaTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("rave_lua_{}_{}", test->name(), ::getpid());
    std::filesystem::create_directories(folder_);
    rig_.add_ranges({-kPi / 2, 0, kPi / 2}, 0, 8.0);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& source) {
    std::ofstream(folder_ / "p.lua") << source;
    rig_.params.set_text("file", (folder_ / "p.lua").string());
  }
  std::string start(const std::string& source, std::uint64_t seed = 1) {
    write(source);
    return program_.start(seed);
  }
  Command decide(const std::vector<float>& ranges_m = {kFree, kFree, kFree}) {
    rig_.sensors[0].give<float>(ranges_m, k_ * 100'000'000LL);
    program_.decide({k_++ * 100'000'000LL});
    return rig_.command();
  }
  /// The error of a program that fails in its first decision.
  std::string failure(const std::string& source) {
    EXPECT_EQ(start(source), "");
    rig_.sensors[0].give<float>({1, 2, 3}, 0);
    return program_.failure_of({});
  }

  std::filesystem::path folder_;
  ProgramUnderTest program_{rave_register_plugin, "lua"};
  Rig& rig_ = program_.add_robot();
  std::int64_t k_ = 0;
};

TEST_F(LuaTest, SensesAndDrives) {
  ASSERT_EQ(start("function decide()\n"
                  "  local rays = reading('ranges')\n"
                  "  velocity(math.min(rays[2], 2) / 4, nearest(60, 120) < 1 and -0.5 or 0)\n"
                  "end\n"),
            "");
  EXPECT_EQ(decide({kFree, kFree, kFree}), velocity_command(0.5, 0));
  EXPECT_EQ(decide({kFree, 1, kFree}), velocity_command(0.25, 0));
  EXPECT_EQ(decide({kFree, 1, 0.5F}), velocity_command(0.25, -0.5));
}

TEST_F(LuaTest, ReadsEveryKindByItsFields) {
  rig_.add(ReadingKind::kContact, "bumper");
  rig_.add(ReadingKind::kSightings, "camera");
  rig_.add(ReadingKind::kValues, "battery");
  ASSERT_EQ(start("function decide()\n"
                  "  local seen = reading('camera')\n"
                  "  if not reading('bumper') then velocity(9) return end\n"
                  "  velocity(reading('bumper').touching + #seen * 10 + seen[2].code * 100,\n"
                  "           reading('battery')[1])\n"
                  "end\n"),
            "");
  EXPECT_EQ(decide(), velocity_command(9, 0)) << "there is no sample yet";
  rig_.sensors[1].give<ContactReading>({{1, 0}}, 0);
  rig_.sensors[2].give<Sighting>({{0, 3, 1, 0, 0}, {0, 7, 2, 0, 0}}, 0);
  rig_.sensors[3].give<double>({0.25}, 0);
  EXPECT_EQ(decide(), velocity_command(721, 0.25));
}

TEST_F(LuaTest, KeepsItsMemoryAndStartsWithParameters) {
  rig_.params.set_text("with", "speed = 0.5, names = {\"a\", \"b\"}");
  ASSERT_EQ(start("function start() memory.count = #param('names') end\n"
                  "function decide()\n"
                  "  memory.count = memory.count + 1\n"
                  "  velocity(param('speed'), memory.count * param('gain', 2))\n"
                  "end\n"),
            "");
  EXPECT_EQ(decide(), velocity_command(0.5, 6));
  EXPECT_EQ(decide(), velocity_command(0.5, 8));
}

TEST_F(LuaTest, IsLoadedAgainWithItsMemory) {
  ASSERT_EQ(start("function decide() memory.n = (memory.n or 0) + 1 velocity(memory.n) end\n"), "");
  EXPECT_EQ(decide(), velocity_command(1, 0));
  write("function decide() memory.n = memory.n + 10 velocity(memory.n) end\n");
  EXPECT_EQ(program_.update(), "");
  EXPECT_EQ(decide(), velocity_command(11, 0));
  write("function decide( end\n");
  EXPECT_NE(program_.update().find("p.lua:1"), std::string::npos);
  EXPECT_EQ(decide(), velocity_command(21, 0)) << "the old program goes on";
}

TEST_F(LuaTest, RandomNumbersAreThoseOfTheRun) {
  const std::string source =
      "function decide() velocity(math.random(), math.random(3)) memory.x = math.random(5, 9) "
      "end\n";
  ASSERT_EQ(start(source), "");
  const Command first = decide();
  EXPECT_GE(first.value[0], 0);
  EXPECT_LT(first.value[0], 1);
  EXPECT_TRUE(first.value[1] == 1 || first.value[1] == 2 || first.value[1] == 3);
  EXPECT_NE(decide(), first);
  ProgramUnderTest again(rave_register_plugin, "lua");
  Rig& rig = again.add_robot();
  rig.params.set_text("file", (folder_ / "p.lua").string());
  ASSERT_EQ(again.start(1), "");
  again.decide({});
  EXPECT_EQ(rig.command(), first);
}

TEST_F(LuaTest, TalksToOtherRobots) {
  rig_.add_radio("radio");
  ASSERT_EQ(start("function decide()\n"
                  "  for _, m in ipairs(messages()) do send(m.from .. ' said ' .. m.text) end\n"
                  "end\n"),
            "");
  rig_.radios[0].hear(4, {}, std::array<char, 2>{'h', 'i'});
  decide();
  ASSERT_EQ(rig_.radios[0].sent().size(), 1U);
  const auto bytes = (*rig_.radios[0].sent().begin()).bytes;
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), "4 said hi");
}

TEST_F(LuaTest, ErrorsSayWhereTheyAre) {
  EXPECT_NE(
      failure("function decide()\n  velocity('fast')\nend\n")
          .find("p.lua:2: `velocity`: expected a finite number as argument 1, found \"fast\""),
      std::string::npos);
}

TEST_F(LuaTest, AWrongSensorNamesTheNearest) {
  const std::string error = failure("function decide()\n\n  reading('rangs')\nend\n");
  EXPECT_NE(error.find("p.lua:3"), std::string::npos) << error;
  EXPECT_NE(error.find("the robot has no sensor `rangs`; did you mean `ranges`?"),
            std::string::npos)
      << error;
}

TEST_F(LuaTest, ALoopWithoutEndIsStopped) {
  const std::string error = failure("function decide() while true do end end\n");
  EXPECT_NE(error.find("instructions"), std::string::npos) << error;
}

TEST_F(LuaTest, RefusesFilesThatAreNoPrograms) {
  EXPECT_NE(start("x = 1\n").find("p.lua defines no function `decide`"), std::string::npos);
}

TEST_F(LuaTest, RefusesToAskBeforeThereIsAnything) {
  const std::string error = start("velocity(1, 0)\nfunction decide() end\n");
  EXPECT_NE(error.find("p.lua:1"), std::string::npos) << error;
  EXPECT_NE(error.find("ask in decide()"), std::string::npos) << error;
}

TEST_F(LuaTest, RefusesAMissingFileAndWrongParameters) {
  rig_.params.set_text("file", "/nowhere/p.lua");
  EXPECT_NE(program_.start(1).find("/nowhere/p.lua"), std::string::npos);
  write("function decide() end\n");
  rig_.params.set_text("with", "speed 3");
  EXPECT_NE(program_.update().find("with:1"), std::string::npos) << program_.update();
}

}  // namespace
}  // namespace rave
