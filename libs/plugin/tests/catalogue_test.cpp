// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/catalogue.hpp"

#include "catalogue_fixture.hpp"
#include "rave/plugin/keep_loaded.hpp"

namespace rave::plugin {
namespace {

namespace fs = std::filesystem;

TEST_F(CatalogueTest, FindsADriverAndItsDescription) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  const auto driver = catalogue_.find(kProgram, "sleeper");
  ASSERT_TRUE(driver) << driver.error().text();
  EXPECT_STREQ((*driver)->info.summary, "Sleeps where it stands.");
  EXPECT_EQ((*driver)->info.param_count, 3U);
  EXPECT_EQ((*driver)->file, built("good/pair.so"));
  EXPECT_NE((*driver)->ops, nullptr);
  EXPECT_TRUE(catalogue_.rejected().empty());
}

TEST_F(CatalogueTest, FindsTheSecondDriverOfAFileAmongSeveralKinds) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  const auto driver = catalogue_.find(kSensors, "ear");
  ASSERT_TRUE(driver) << driver.error().text();
  EXPECT_EQ((*driver)->info.kind, DriverKind::kSensor);
}

TEST_F(CatalogueTest, MapsOnlyTheFileThatIsNeededAndUnmapsItAtTheEnd) {
  {
    Catalogue catalogue(host());
    ASSERT_TRUE(catalogue.add_folder(built("good")));
    expect_unmapped("good/pair.so");
    ASSERT_TRUE(catalogue.find(kProgram, "sleeper"));
    EXPECT_TRUE(is_mapped("good/pair.so"));
    expect_unmapped("good/bystander.so");
    ASSERT_TRUE(catalogue.find(kController, "bystander"));
    EXPECT_TRUE(is_mapped("good/bystander.so"));
  }
  expect_unmapped("good/pair.so");
  expect_unmapped("good/bystander.so");
}

TEST_F(CatalogueTest, WhatIsToStayIsNotUnmappedAtTheEnd) {
  // Of its own, for it stays until this process ends.
  const fs::path file = own_ / "stays.so";
  fs::copy_file(built("good/bystander.so"), file);
  const auto use = [&](bool stays) {
    Catalogue catalogue(host());
    ASSERT_TRUE(catalogue.add_folder(own_));
    const auto driver = catalogue.find(kController, "bystander");
    ASSERT_TRUE(driver) << driver.error().text();
    if (stays) keep_loaded((*driver)->ops);
  };
  use(false);
  expect_unmapped("stays.so");
  use(true);
  EXPECT_TRUE(is_mapped("stays.so"));
  keep_loaded(nullptr);
  keep_loaded(&file);
}

TEST_F(CatalogueTest, KeepsTheAddressOfADriver) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  const Driver* first = catalogue_.find(kProgram, "sleeper").value();
  EXPECT_EQ(catalogue_.all().size(), 3U);
  EXPECT_EQ(catalogue_.find(kProgram, "sleeper").value(), first);
}

TEST_F(CatalogueTest, ListsAllByKindAndName) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  std::vector<std::string> names;
  for (const Driver* driver : catalogue_.all()) names.emplace_back(driver->info.name);
  EXPECT_EQ(names, (std::vector<std::string>{"ear", "bystander", "sleeper"}));
}

TEST_F(CatalogueTest, TheEarlierFolderWins) {
  ASSERT_TRUE(catalogue_.add_folder(built("override")));
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  EXPECT_STREQ(catalogue_.find(kController, "bystander").value()->info.version, "2.0");
  expect_unmapped("good/bystander.so");
  EXPECT_EQ(catalogue_.all().size(), 3U);

  Catalogue reversed(host());
  ASSERT_TRUE(reversed.add_folder(built("good")));
  ASSERT_TRUE(reversed.add_folder(built("override")));
  EXPECT_STREQ(reversed.find(kController, "bystander").value()->info.version, "1.0");
}

TEST_F(CatalogueTest, AFileThatIsNamedWinsOverTheFolders) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  ASSERT_TRUE(catalogue_.load(built("override/own_bystander.so")));
  EXPECT_STREQ(catalogue_.find(kController, "bystander").value()->info.version, "2.0");
  const auto again = catalogue_.load(built("twins/first.so"));
  expect_says(message(again), "own_bystander.so` and `");
  EXPECT_STREQ(catalogue_.find(kController, "bystander").value()->info.version, "2.0");
}

TEST_F(CatalogueTest, AFolderTwiceAndALinkToAFileAreNoConflict) {
  fs::copy_file(built("good/pair.so"), own_ / "pair.so");
  fs::create_symlink("pair.so", own_ / "same.so");
  ASSERT_TRUE(catalogue_.add_folder(own_));
  ASSERT_TRUE(catalogue_.add_folder(own_));
  EXPECT_TRUE(catalogue_.find(kProgram, "sleeper"));
  EXPECT_TRUE(catalogue_.rejected().empty());
}

}  // namespace
}  // namespace rave::plugin
