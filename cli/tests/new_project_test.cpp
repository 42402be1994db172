// SPDX-License-Identifier: Apache-2.0
#include "new_project.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "rave/base/file.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kTemplates = fs::path(RAVE_SOURCE_DIR) / "share/templates";

class NewProject : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / ("rave-new-" + std::to_string(::getpid()) + "-" + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string error_of(const std::string& name, const fs::path& templates) const {
    const Status made = create_project(ProjectKind::kProgram, name, templates, folder_ / "made");
    return made ? "" : made.error().text();
  }

  fs::path folder_;
};

TEST_F(NewProject, FillsInNamesOfFilesAndText) {
  const fs::path made = folder_ / "deep" / "avoid_walls";
  ASSERT_TRUE(create_project(ProjectKind::kProgram, "avoid_walls", kTemplates, made));
  const Result<std::string> text = read_file(made / "avoid_walls.cpp");
  ASSERT_TRUE(text) << text.error().text();
  EXPECT_NE(text->find("add_program<AvoidWalls>"), std::string::npos);
  EXPECT_NE(text->find("RAVE_PLUGIN(\"avoid_walls\")"), std::string::npos);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(made)) {
    ++files;
    const Result<std::string> content = read_file(entry.path());
    ASSERT_TRUE(content);
    EXPECT_EQ(content->find("@NAME@"), std::string::npos) << entry.path();
    EXPECT_EQ(content->find("@CLASS@"), std::string::npos) << entry.path();
    EXPECT_EQ(content->find("@TITLE@"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(files, 5U);
}

TEST_F(NewProject, ADriverIsNoProgram) {
  ASSERT_TRUE(create_project(ProjectKind::kDriver, "beacon", kTemplates, folder_ / "beacon"));
  const Result<std::string> text = read_file(folder_ / "beacon" / "beacon.cpp");
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("RAVE_VIRTUAL_PLUGIN(\"beacon\")"), std::string::npos);
}

TEST_F(NewProject, APanelHasItsTest) {
  ASSERT_TRUE(create_project(ProjectKind::kPanel, "speeds", kTemplates, folder_ / "speeds"));
  const Result<std::string> test = read_file(folder_ / "speeds" / "speeds.test.mjs");
  ASSERT_TRUE(test) << test.error().text();
  EXPECT_NE(test->find("from './speeds.mjs'"), std::string::npos);
  const Result<std::string> panel = read_file(folder_ / "speeds" / "speeds.mjs");
  ASSERT_TRUE(panel);
  EXPECT_NE(panel->find("class Speeds extends"), std::string::npos);
  ASSERT_TRUE(create_project(ProjectKind::kPanel, "who_is_near", kTemplates, folder_ / "who"));
  const Result<std::string> who = read_file(folder_ / "who" / "who_is_near.mjs");
  ASSERT_TRUE(who);
  EXPECT_NE(who->find("title: 'Who is near', element: WhoIsNear"), std::string::npos);
  EXPECT_EQ(panel->find("@NAME@"), std::string::npos);
}

TEST_F(NewProject, RefusesNames) {
  for (const char* name :
       {"", "Walls", "avoid-walls", "2walls", "_walls", "walls_", "a__b", "ä", "../walls", "a b"}) {
    EXPECT_NE(error_of(name, kTemplates).find("expected lower_snake_case"), std::string::npos)
        << name;
  }
  EXPECT_NE(error_of("test", kTemplates).find("reserved by the build"), std::string::npos);
  EXPECT_NE(error_of(std::string(49, 'a'), kTemplates).find("at most 48"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(NewProject, LeavesWhatExistsAlone) {
  fs::create_directories(folder_ / "made");
  EXPECT_NE(error_of("walls", kTemplates).find("already exists"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder_ / "made"));
}

TEST_F(NewProject, NoTemplatesLeaveNothing) {
  EXPECT_NE(error_of("walls", folder_ / "nowhere").find("no templates in"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST(ProjectKindText, NamesTheNearest) {
  EXPECT_EQ(parse_project_kind("driver").value(), ProjectKind::kDriver);
  const auto wrong = parse_project_kind("drivr");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().text(), "cannot create a new `drivr`; did you mean `driver`?");
}

TEST(ClassName, JoinsTheWords) {
  EXPECT_EQ(class_name_of("avoid_walls"), "AvoidWalls");
  EXPECT_EQ(class_name_of("a1_2b"), "A12b");
}

}  // namespace
}  // namespace rave::cli
