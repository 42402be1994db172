// SPDX-License-Identifier: Apache-2.0
#include "log_sender.hpp"

#include <utility>

#include "message.hpp"

namespace rave::isolation {

HostServices LogSender::services() noexcept {
  return {this, [](void* context, LogLevel level, const char* text, std::uint64_t size) {
            static_cast<LogSender*>(context)->write(level, {text, size});
          }};
}

std::uint32_t LogSender::begin_next() noexcept {
  const std::lock_guard lock(mutex_);
  lines_ = 0;
  bytes_ = 0;
  return std::exchange(dropped_, 0);
}

void LogSender::write(LogLevel level, std::string_view text) noexcept {
  const std::lock_guard lock(mutex_);
  text = text.substr(0, kMaxLogLineBytes);
  const bool fits = lines_ < kMaxLogLines && bytes_ + text.size() <= kMaxLogBytes;
  const MessageHead head{MessageKind::kLog, static_cast<std::uint32_t>(level), 0};
  // Without waiting: a program that logs faster than the host reads loses lines, but never blocks.
  if (!fits || !send_message(socket_, head, text, false)) {
    ++dropped_;
    return;
  }
  ++lines_;
  bytes_ += text.size();
}

}  // namespace rave::isolation
