// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "rave/base/file.hpp"
#include "rave/keys/key_set.hpp"

namespace rave::keys::testing {

inline constexpr std::int64_t kNow_s = 1'800'000'000;  // 15 January 2027
inline constexpr std::int64_t kDay_s = 86'400;

/// A folder of its own for each test.
class Scratch : public ::testing::Test {
 public:
  ~Scratch() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 protected:
  Scratch() {
    std::string name = std::filesystem::temp_directory_path() / "rave-keys-XXXXXX";
    if (::mkdtemp(name.data()) != nullptr) folder_ = name;
  }

  /// A set of two members in the folder `set`.
  [[nodiscard]] NewKeySet plan() const {
    return {folder_ / "set", "lab", 365, {"left", "right"}, kNow_s};
  }
  [[nodiscard]] static std::string error_of(const Status& status) {
    return status ? "none" : status.error().message;
  }
  [[nodiscard]] static std::string text_of(const std::filesystem::path& file) {
    return read_file(file).value_or("");
  }
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
  }
  [[nodiscard]] static unsigned mode_of(const std::filesystem::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
  }
  /// What lies in a folder, by name.
  [[nodiscard]] static std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
  }

  std::filesystem::path folder_;
};

}  // namespace rave::keys::testing
