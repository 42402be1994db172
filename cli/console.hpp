// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/report/progress.hpp"
#include "terminal.hpp"

namespace spdlog {
class logger;
}

namespace rave::cli {

/// The output of a run in progress: one progress line at the bottom of the terminal, warnings and
/// errors above it, and every message with the time of day in a file. Writes to stderr. Messages
/// may come from any thread; everything else belongs to one.
class Console final : public LogSink {
 public:
  /// Quiet: no progress, and of messages only errors.
  explicit Console(bool quiet);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console() override;

  /// From here on all messages also go to this file, which is replaced. Errors: kIo.
  Status open_file(const std::filesystem::path& path);

  void write(LogLevel level, std::string_view source, std::string_view message) override;

  /// On a terminal the line is redrawn at most ten times a second; elsewhere a plain line appears
  /// about every ten seconds.
  void show(const report::Progress& progress);
  /// Why messages are missing in the file, as on a full disk; empty: all are there.
  [[nodiscard]] std::string lost_messages();
  /// Removes the progress line, for what comes after the run.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  /// Both with `mutex_` held.
  void draw();
  void erase();

  const bool quiet_;
  const Terminal terminal_;
  std::mutex mutex_;  // over the terminal: whose line it is
  std::string line_;  // what stands at the bottom; empty: nothing
  Clock::time_point next_;
  std::mutex lost_mutex_;                   // over the next one, which any thread may set
  std::string lost_;                        // the first error of the file
  std::shared_ptr<spdlog::logger> screen_;  // owned with spdlog, which hands out shared pointers
  std::shared_ptr<spdlog::logger> file_;    // the same
};

}  // namespace rave::cli
