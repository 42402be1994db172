// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {

/// Accounts in a folder of their own, at a time that the test sets.
class AccountsTest : public ::testing::Test {
 public:
  AccountsTest() {
    std::string name = std::filesystem::temp_directory_path() / "rave-accounts-XXXXXX";
    if (::mkdtemp(name.data()) != nullptr) folder_ = name;
  }
  ~AccountsTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 protected:
  [[nodiscard]] std::unique_ptr<Accounts> opened() {
    auto accounts = Accounts::open(folder_ / "gui", [this] { return now_s_; });
    EXPECT_TRUE(accounts) << accounts.error().text();
    return *std::move(accounts);
  }
  [[nodiscard]] std::string text() const {
    return read_file(folder_ / "gui/accounts").value_or("");
  }
  template <class T>
  static std::string error_of(const Result<T>& result) {
    return result ? "none" : result.error().message;
  }

  std::filesystem::path folder_;
  std::int64_t now_s_ = 1'800'000'000;
};

}  // namespace rave::gui_server
