// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <utility>

namespace rave {

/// Severity of a log line, in ascending order.
enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning, kError };

/// `debug`, `info`, `warning` or `error`.
[[nodiscard]] std::string_view to_string(LogLevel level) noexcept;

/// Receives log messages. A library never prints; its owner gives it a sink. Implementations must
/// accept calls from any thread.
class LogSink {
 public:
  virtual ~LogSink() = default;
  /// `source` names the origin (`robot anna`, `driver utias_camera`); `message` has no newline.
  virtual void write(LogLevel level, std::string_view source, std::string_view message) = 0;

  template <class... Args>
  void info(std::string_view source, fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::kInfo, source, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warn(std::string_view source, fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::kWarning, source, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void error(std::string_view source, fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::kError, source, fmt::format(format, std::forward<Args>(args)...));
  }
};

/// A sink that discards all messages.
class NullLogSink final : public LogSink {
 public:
  void write(LogLevel, std::string_view, std::string_view) override {}
};

}  // namespace rave
