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
  using Clock = Playhead::Clock;

  /// `socket` outlives the session.
  Session(web::Socket& socket, std::string user);

  /// From now on the page sees this source: hello, and all that does not change.
  void show(std::shared_ptr<Source> source);
  void received(std::string_view text);
  /// Sends what is due; called some 60 times a second. `frames`: those of this tick that other
  /// pages were sent, by sequence number.
  void tick(Clock::time_point now, std::map<std::uint32_t, web::Payload>& frames);
  [[nodiscard]] const LookMessage& look() const noexcept { return look_; }

 private:
  void take(const LookMessage& look);
  void take(const AckMessage& ack);
  void take(const TransportMessage& transport);
  void take(const HaltMessage& halt);
  void forget_foreign_sensors();
  void send_past(double now_s);
  void send_frame(std::map<std::uint32_t, web::Payload>& frames);
  void send_readings();
  void send_time(const PlayState& state);
  void send_news();
  void answer(std::string_view to, bool good, std::string_view text);

  web::Socket& socket_;
  std::string user_;
  std::shared_ptr<Source> source_;  ///< Null: there is none yet.
  std::unique_ptr<Playhead> playhead_;
  std::unique_ptr<Cursor> cursor_;
  LookMessage look_;
  PlayState told_state_;  ///< As the page knows it.
  Clock::time_point last_frame_{};
  Clock::time_point last_time_{};
  Clock::time_point last_news_{};
  std::uint32_t sequence_ = 0;
  std::deque<std::uint32_t> on_their_way_;
  std::map<std::pair<LookedAt, std::uint8_t>, double> told_;  ///< Stamp of what was sent last.
  std::uint64_t told_events_ = 0;
  std::uint64_t told_bodies_ = 0;
  std::uint64_t picture_ = 0;  ///< Of the last frame.
  bool changed_ = true;        ///< Something is to be shown that has not been sent.
  bool past_due_ = true;       ///< The page has no past to draw trails with.
  bool broken_ = false;        ///< The source could not show this moment.
  unsigned refusals_ = 0;
  std::shared_ptr<const bool> alive_ =
      std::make_shared<bool>(true);  ///< For answers that come late.
};

}  // namespace rave::gui_server
