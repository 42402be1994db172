// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>

#include "rave/robot/interface.hpp"

namespace rave::isolation {

/// Sends the log lines of a program to the host, within the bounds of message.hpp for each
/// decision. All functions may be called from any thread.
class LogSender {
 public:
  explicit LogSender(int socket) : socket_(socket) {}
  /// Valid as long as this object.
  [[nodiscard]] HostServices services() noexcept;
  /// How many lines were dropped since the last call; a new decision's bounds begin.
  std::uint32_t begin_next() noexcept;

 private:
  void write(LogLevel level, std::string_view text) noexcept;
  int socket_;
  std::mutex mutex_;
  std::size_t lines_ = 0;
  std::size_t bytes_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace rave::isolation
