// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "catalogue_fixture.hpp"

namespace rave::plugin {
namespace {

namespace fs = std::filesystem;

TEST_F(CatalogueTest, SaysThatAFolderIsMissing) {
  const Status status = catalogue_.add_folder(own_ / "none");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kNotFound);
  expect_says(message(status), "there is no plug-in folder `" + (own_ / "none").string() + "`");
}

TEST_F(CatalogueTest, AnUnknownNameGetsTheNearestAndAllOfItsKind) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  const auto driver = catalogue_.find(kProgram, "sleper");
  ASSERT_FALSE(driver);
  EXPECT_EQ(driver.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(message(driver),
            "there is no program `sleper`; did you mean `sleeper`?; the folder of your own "
            "plug-ins is given "
            "with --plugins or RAVE_PLUGIN_PATH");
  EXPECT_EQ(message(catalogue_.find(kSensors, "zzzzzzzzz")),
            "there is no sensor driver `zzzzzzzzz`; there are ear; "
            "the folder of your own plug-ins is given with --plugins or RAVE_PLUGIN_PATH");
}

TEST_F(CatalogueTest, ANameOfAnotherKindIsSaidToBeOne) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  const std::string text = message(catalogue_.find(kSensors, "sleeper"));
  expect_says(text, "there is no sensor driver `sleeper`");
  expect_says(text, "good/pair.so` is a program");
}

TEST_F(CatalogueTest, AFolderWithoutPluginsIsNamedIfADriverIsMissing) {
  ASSERT_TRUE(catalogue_.add_folder(own_));
  expect_says(message(catalogue_.find(kProgram, "zzzzzzzzz")),
              "there is no plug-in in `" + own_.string() + "`");
}

TEST_F(CatalogueTest, AnUnknownNameListsTheRejectedFilesWithReasons) {
  ASSERT_TRUE(catalogue_.add_folder(built("good")));
  ASSERT_TRUE(catalogue_.add_folder(built("bad")));
  const std::string text = message(catalogue_.find(kProgram, "zzzzzzzzz"));
  expect_says(text, "bad/no_stamp.so`: a shared library without the stamp");
  expect_says(text, "bad/unresolved.so`: undefined symbol");
}

TEST_F(CatalogueTest, ARejectedFileOfTheNameGivesItsReason) {
  ASSERT_TRUE(catalogue_.add_folder(built("bad")));
  const auto other = catalogue_.find(kProgram, "from_another_age");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kIncompatible);
  expect_says(message(other), "bad/wrong_interface.so`: built for another plug-in interface");
  EXPECT_EQ(message(other).find("there is no"), std::string::npos);
  expect_says(message(catalogue_.find(kProgram, "no_stamp")), "bad/no_stamp.so`: a shared library");
}

TEST_F(CatalogueTest, TwoFilesOfOneFolderWithOneNameAreAnErrorNamingBoth) {
  ASSERT_TRUE(catalogue_.add_folder(built("twins")));
  const auto driver = catalogue_.find(kController, "bystander");
  ASSERT_FALSE(driver);
  EXPECT_EQ(message(driver), "plug-ins `" + built("twins/first.so").string() + "` and `" +
                                 built("twins/second.so").string() +
                                 "` both provide `bystander`: remove one of them");
  ASSERT_EQ(catalogue_.rejected().size(), 1U);
  EXPECT_EQ(catalogue_.rejected().front().file, built("twins/second.so"));
}

TEST_F(CatalogueTest, FilesThatAreNoPluginsAreRejectedWithTheirReason) {
  std::ofstream(own_ / "text.so") << "not a library\n";
  fs::copy_file(built("good/pair.so"), own_ / "cut.so");
  fs::resize_file(own_ / "cut.so", fs::file_size(own_ / "cut.so") / 2);
  fs::create_symlink("gone", own_ / "dangling.so");
  fs::create_directory(own_ / "folder.so");
  std::ofstream(own_ / "README") << "no plug-in and no error\n";
  ASSERT_TRUE(catalogue_.add_folder(own_));
  EXPECT_EQ(catalogue_.rejected().size(), 4U);
  expect_says(message(catalogue_.find(kProgram, "text")), "not a shared library (no ELF file)");
  expect_says(message(catalogue_.find(kProgram, "cut")), "damaged or cut off: its table of sect");
  expect_says(message(catalogue_.find(kProgram, "dangling")), "No such file");
  expect_says(message(catalogue_.find(kProgram, "folder")), "it is a folder");
}

TEST_F(CatalogueTest, AMissingFileIsNamed) {
  const Status status = catalogue_.load(own_ / "none.so");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kNotFound);
  expect_says(message(status), (own_ / "none.so").string());
}

TEST_F(CatalogueTest, AMissingSymbolAndAMissingEntryPointAreNamed) {
  const std::string symbol = message(catalogue_.load(built("bad/unresolved.so")));
  expect_says(symbol,
              "cannot use plug-in `" + built("bad/unresolved.so").string() + "`: undefined");
  expect_says(symbol, "missing_library::missing_function(int)");
  const std::string entry = message(catalogue_.load(built("bad/no_entry.so")));
  expect_says(entry, built("bad/no_entry.so").string());
  expect_says(entry, "entry point `rave_register_plugin` is missing");
  expect_unmapped("bad/no_entry.so");
}

struct Fault {
  const char* file;
  const char* reason;
};

class FaultyPlugin : public CatalogueTest, public testing::WithParamInterface<Fault> {};

TEST_P(FaultyPlugin, IsRefusedAndUnloaded) {
  const fs::path file = built(std::string("bad/") + GetParam().file + ".so");
  const Status status = catalogue_.load(file);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kPlugin);
  expect_says(message(status), "cannot use plug-in `" + file.string() + "`");
  expect_says(message(status), GetParam().reason);
  expect_unmapped(file.string());
  ASSERT_EQ(catalogue_.rejected().size(), 1U);
  EXPECT_TRUE(catalogue_.all().empty());
  EXPECT_EQ(message(catalogue_.load(file)), message(status));
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultyPlugin,
    testing::Values(
        Fault{"unlisted", "it registers sensor `stowaway`, which its stamp does not list"},
        Fault{"unregistered", "its stamp lists `ghost`, which it does not register"},
        Fault{"twice", "it registers sensor `twice` twice"},
        Fault{"nothing", "its stamp lists `nothing`, which it does not register"},
        Fault{"empty_name", "registers a driver with an empty name"},
        Fault{"null_ops", "driver `null_ops` has no function table"},
        Fault{"range", "parameter `range_m` of driver `range`: its range is reversed (min 3"},
        Fault{"default", "parameter `count` of driver `default`: its default 7 is outside 1 to 5"},
        Fault{"choice",
              "parameter `mode` of driver `choice`: its default `fats` is not one of its"},
        Fault{"param_twice", "driver `param_twice` has parameter `gain` twice"},
        Fault{"no_summary", "driver `no_summary` has no summary"},
        Fault{"throws", "`rave_register_plugin` threw: no device"}),
    [](const auto& fault) { return std::string(fault.param.file); });

}  // namespace
}  // namespace rave::plugin
