// SPDX-License-Identifier: Apache-2.0
#include "run/components.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "live/component_watch.hpp"

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

TEST_F(Components, AreReadAgainWhenTheirFileHasChanged) {
  const auto write = [this](const char* name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  };
  const std::string robots =
      "robots: [{name: r, pose: {x_m: 0, y_m: 0}, robot: {body: {shapes: [{disc_radius_m: 0.2, "
      "z_m: [0, 0.3]}]}}}]\n";
  write("scenario.yaml", "name: s\nduration_s: 1\ngui: {file: gui.yaml}\n" + robots);
  write("gui.yaml", "components: [{module: there.mjs, roles: [commander]}]\n");
  ComponentWatch watch(folder_ / "scenario.yaml");
  EXPECT_FALSE(watch.look());
  write("more.mjs", "export const component = 2;\n");
  write("gui.yaml",
        "components: [{module: there.mjs, roles: [commander]}, {module: more.mjs, roles: "
        "[observer]}]\n");
  auto read = watch.look();
  ASSERT_TRUE(read);
  ASSERT_TRUE(*read) << read->error().text();
  ASSERT_EQ((*read)->size(), 2U);
  EXPECT_EQ((**read)[1].name, "more");
  EXPECT_FALSE(watch.look());
  // An error is told once, with its place; the same for a module that is missing until it is there.
  write("gui.yaml", "components: [{modul: there.mjs, roles: [commander]}]\n");
  read = watch.look();
  ASSERT_TRUE(read);
  ASSERT_FALSE(*read);
  EXPECT_NE(read->error().text().find("gui.yaml:1:"), std::string::npos) << read->error().text();
  EXPECT_FALSE(watch.look());
  write("gui.yaml", "components: [{module: later.mjs, roles: [commander]}]\n");
  read = watch.look();
  ASSERT_TRUE(read && !*read);
  write("later.mjs", "export const component = 3;\n");
  read = watch.look();
  ASSERT_TRUE(read && *read);
  EXPECT_EQ((**read)[0].name, "later");
  // The list may move into the scenario.
  write("scenario.yaml", "name: s\nduration_s: 1\n" + robots);
  read = watch.look();
  ASSERT_TRUE(read && *read);
  EXPECT_TRUE((*read)->empty());
  EXPECT_FALSE(ComponentWatch("").look());
}

}  // namespace
}  // namespace rave::gui_server
