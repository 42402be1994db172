// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

#include "rave/base/file.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/robot/interface_hash.hpp"

namespace rave::plugin {

inline constexpr std::array kProgram{DriverKind::kProgram};
inline constexpr std::array kSensors{DriverKind::kSensor, DriverKind::kVirtualSensor};
inline constexpr std::array kController{DriverKind::kController};

/// A test with the plug-ins that the build made for it and a folder of its own.
class CatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    own_ = std::filesystem::temp_directory_path() /
           ("rave_catalogue_test_" + std::to_string(::getpid()));
    std::filesystem::create_directories(own_);
  }
  void TearDown() override { std::filesystem::remove_all(own_); }

  static std::filesystem::path built(std::string_view name) {
    return std::filesystem::path(RAVE_BINARY_DIR) / "tests/plugins" / name;
  }
  static Stamp host() { return make_stamp(robot_interface_hash(), 0, ""); }
  static bool is_mapped(std::string_view file) {
    return read_file("/proc/self/maps").value().find(file) != std::string::npos;
  }
  /// The thread sanitizer needs what it has seen until the end, so there plug-ins stay.
  static void expect_unmapped([[maybe_unused]] std::string_view file) {
#if !defined(__SANITIZE_THREAD__)
    EXPECT_FALSE(is_mapped(file)) << file;
#endif
  }
  static void expect_says(const std::string& message, std::string_view part) {
    EXPECT_NE(message.find(part), std::string::npos) << message << "\n  lacks: " << part;
  }
  /// The message of a failed call.
  template <class T>
  static std::string message(const Result<T>& result) {
    return result ? "no error" : result.error().message;
  }

  std::filesystem::path own_;
  Catalogue catalogue_{host()};
};

}  // namespace rave::plugin
