// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <atomic>
#include <mutex>
#include <stop_token>
#include <thread>

#include "rave/base/bell.hpp"

namespace rave::cli {

/// Watches for the end of a command with a display: SIGINT, SIGTERM, SIGQUIT, SIGHUP or the key q;
/// and for the key r. Create it before any other thread of the process, so that all of them leave
/// the signals to it. One per process.
class KeyWatch {
 public:
  /// `keys`: the terminal behind the standard input gives each key at once, and shows none. Where
  /// the system grants no thread, neither keys nor signals are read, and the latter end the process
  /// as they do any other; standard error says so.
  explicit KeyWatch(bool keys);
  KeyWatch(const KeyWatch&) = delete;
  KeyWatch& operator=(const KeyWatch&) = delete;
  /// Restores the terminal and the signals.
  ~KeyWatch();

  [[nodiscard]] bool ended() const noexcept { return ended_.load(); }
  /// Whether r was pressed since the last call.
  [[nodiscard]] bool take_toggle() noexcept { return toggled_.exchange(false); }
  /// A token that stops at the next event from now on, or at once after the end.
  [[nodiscard]] std::stop_token next();
  /// A token that stops at the end.
  [[nodiscard]] std::stop_token end() const { return over_.get_token(); }

 private:
  void watch();
  /// Restores the terminal and the signals.
  void give_back() const;
  void take_key();
  void end_it();
  void wake();

  ::termios before_{};  ///< Read before it is known that there are keys.
  const bool keys_;
  Descriptor signals_;
  Bell quit_;  ///< Becomes readable when the thread shall end.
  std::atomic<bool> ended_{false};
  std::atomic<bool> toggled_{false};
  std::mutex mutex_;  // over `happened_`
  std::stop_source happened_;
  std::stop_source over_;
  std::thread thread_;
};

}  // namespace rave::cli
