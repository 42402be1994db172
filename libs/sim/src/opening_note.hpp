// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <mutex>
#include <string>
#include <string_view>

namespace rave::sim {

/// Which driver is being opened. Any thread.
class OpeningNote {
 public:
  void set(std::string_view kind, std::string_view name, std::string_view driver) {
    const std::lock_guard lock(mutex_);
    text_ = fmt::format("{} `{}` (driver `{}`)", kind, name, driver);
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    text_.clear();
  }
  /// Empty: none.
  [[nodiscard]] std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

}  // namespace rave::sim
