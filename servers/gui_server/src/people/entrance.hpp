// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace rave::gui_server {

/// Who may come in: keys of links that work once, and the sessions that they began. Keys and
/// sessions are kept as hashes only. Any thread.
class Entrance {
 public:
  /// A key of 192 random bits, for a link; it works once, within a day.
  [[nodiscard]] std::string new_key();
  /// Takes a key and begins a session; returns its secret, or nothing if the key is not known.
  [[nodiscard]] std::optional<std::string> enter(std::string_view key);
  /// Whether a secret is that of a session.
  [[nodiscard]] bool knows(std::string_view secret) const;
  /// Ends a session, if it is one.
  void leave(std::string_view secret);

 private:
  using Clock = std::chrono::steady_clock;
  mutable std::mutex mutex_;
  std::map<std::string, Clock::time_point> keys_;      ///< By hash: when they end.
  std::map<std::string, Clock::time_point> sessions_;  ///< The same.
};

}  // namespace rave::gui_server
