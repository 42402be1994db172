// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <algorithm>
#include <array>

#include "rave/base/control_characters.hpp"

namespace rave::cli {
namespace {

constexpr std::chrono::milliseconds kRedraw{90};
constexpr std::chrono::seconds kPlainLine{10};
constexpr std::size_t kPlainWidth = 120;

spdlog::level::level_enum level_of(LogLevel level) noexcept {
  constexpr std::array kLevels = {spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                                  spdlog::level::err};
  // The level of a message is what a plug-in says.
  return kLevels[std::min(static_cast<std::size_t>(level), kLevels.size() - 1)];
}

/// No message may move the cursor or begin a line of its own.
std::string one_line(std::string_view text) { return without_control_characters(text, " "); }

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(terminal_of(stderr)) {
  const auto colour = terminal_.colour ? spdlog::color_mode::always : spdlog::color_mode::never;
  screen_ = std::make_shared<spdlog::logger>(
      "screen", std::make_shared<spdlog::sinks::stderr_color_sink_mt>(colour));
  screen_->set_pattern("%^%l%$: %v");
  screen_->set_level(quiet ? spdlog::level::err : spdlog::level::warn);
}

Console::~Console() { clear(); }

Status Console::open_file(const std::filesystem::path& path) {
  try {
    file_ = std::make_shared<spdlog::logger>(
        "file", std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string(), true));
  } catch (const spdlog::spdlog_ex& e) {
    return fail(ErrorCode::kIo, "{}", e.what());
  }
  file_->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  file_->set_level(spdlog::level::debug);
  // A process that is killed leaves what it said; only details may be lost.
  file_->flush_on(spdlog::level::info);
  file_->set_error_handler([this](const std::string& error) {
    const std::lock_guard lock(lost_mutex_);
    if (lost_.empty()) lost_ = error;
  });
  return {};
}

std::string Console::lost_messages() {
  if (file_) file_->flush();
  const std::lock_guard lock(lost_mutex_);
  return lost_.empty() ? std::string() : fmt::format("messages are not written: {}", lost_);
}

void Console::write(LogLevel level, std::string_view source, std::string_view message) {
  const std::string text = fmt::format("{}: {}", one_line(source), one_line(message));
  if (file_) file_->log(level_of(level), text);
  if (!screen_->should_log(level_of(level))) return;
  const std::lock_guard lock(mutex_);
  // The line of progress is below all messages: erased, and drawn again behind the new one.
  const std::string line = line_;
  erase();
  screen_->log(level_of(level), text);
  line_ = line;
  draw();
}

void Console::show(const report::Progress& progress) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  // The first plain line comes after the pause, as a short run needs none.
  if (!terminal_.is_terminal && next_ == Clock::time_point{}) next_ = now + kPlainLine;
  if (now < next_) return;
  next_ = now + (terminal_.is_terminal ? Clock::duration(kRedraw) : Clock::duration(kPlainLine));
  if (terminal_.is_terminal) {
    // The last column stays free: writing there makes some terminals begin a new line.
    const std::size_t width = terminal_of(stderr).width;
    line_ = report::format_progress(progress, width > 1 ? width - 1 : width);
    draw();
    return;
  }
  std::string line = report::format_progress(progress, kPlainWidth);
  line.erase(line.find_last_not_of(' ') + 1);
  put(stderr, line + "\n");
}

void Console::clear() {
  const std::lock_guard lock(mutex_);
  erase();
}

void Console::draw() {
  if (!line_.empty()) put(stderr, "\r" + line_);
}

void Console::erase() {
  if (!line_.empty()) put(stderr, "\r\x1b[K");
  line_.clear();
}

}  // namespace rave::cli
