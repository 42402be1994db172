// SPDX-License-Identifier: Apache-2.0
#include "components.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace rave::gui_server {
namespace {

class Components : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "rave_components";
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "there.mjs") << "export const component = 1;\n";
    for (const char* name : {"gone.mjs", "there.mjs"}) {
      config::GuiComponentFile file;
      file.module.value = (folder_ / name).string();
      file.roles = {config::GuiRole::kCommander};
      gui_.components.push_back(file);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  config::GuiFile gui_;
};

TEST_F(Components, OfARunMustBeThere) {
  const auto components = components_of(gui_);
  ASSERT_FALSE(components);
  EXPECT_NE(components.error().text().find("gone.mjs` of the page is not a file"),
            std::string::npos)
      << components.error().text();
}

TEST_F(Components, OfARecordingAreThoseThatAreLeft) {
  const auto components = components_left(gui_);
  ASSERT_EQ(components.size(), 1U);
  EXPECT_EQ(components[0].name, "there");
  EXPECT_TRUE(components[0].is_for(Role::kCommander));
  EXPECT_FALSE(components[0].is_for(Role::kObserver));
  EXPECT_EQ(component_at(components, "/components/0/there.js"), components.data());
}

}  // namespace
}  // namespace rave::gui_server
