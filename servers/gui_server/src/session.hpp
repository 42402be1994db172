// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "page_message.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// One page that is connected: what it looks at, its place in time, what is on its way to it. The
/// thread of the server.
class Session {
 public:
  using Clock = std::chrono::steady_clock;

  /// Says hello and all that does not change. `socket` and `source` outlive the session.
  Session(web::Socket& socket, Source& source, std::string user);

  void received(std::string_view text);
  /// Sends what is due; called some 60 times a second.
  void tick(Clock::time_point now);

 private:
  void begin();
  void take(const LookMessage& look);
  void take(const AckMessage& ack);
  void take(const TransportMessage& transport);
  void take(const HaltMessage& halt);
  void go_to(double time_s);
  void send_past();
  void send_frame();
  void send_readings();
  void send_time();
  void answer(std::string_view to, bool good, std::string_view text);
  /// Where the replay should be by now.
  [[nodiscard]] double due_s(Clock::time_point now) const;

  web::Socket& socket_;
  Source& source_;
  std::string user_;
  std::unique_ptr<Cursor> cursor_;
  LookMessage look_;
  bool running_ = true;
  double pace_ = 1;
  double at_s_ = 0;  ///< At `since_`.
  Clock::time_point since_{};
  Clock::time_point last_frame_{};
  Clock::time_point last_time_{};
  std::uint32_t sequence_ = 0;
  std::deque<std::uint32_t> on_their_way_;
  std::map<std::pair<LookedAt, std::uint8_t>, double> told_;  ///< Stamp of what was sent last.
  bool changed_ = true;   ///< Something is to be shown that has not been sent.
  bool past_due_ = true;  ///< The page has no past to draw trails with.
  unsigned refusals_ = 0;
};

}  // namespace rave::gui_server
