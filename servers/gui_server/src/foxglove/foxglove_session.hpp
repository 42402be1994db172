// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "foxglove/foxglove_message.hpp"
#include "foxglove/foxglove_topics.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// Messages of a tick that several clients are sent, by source, serial number of the picture, and
/// kind.
using FoxgloveFrames =
    std::map<std::tuple<const Source*, std::uint32_t, FoxgloveTopics::Kind>, std::string>;

/// One Foxglove client that is connected: what it subscribes to, and its place in time. It is only
/// told; what it asks but subscriptions is refused. The thread of the server.
class FoxgloveSession {
 public:
  using Clock = Playhead::Clock;
  static constexpr double kMaxHz = 30;

  /// Says who the server is, and that it has nothing yet. `socket` outlives the session. `server`:
  /// another text whenever it is another one.
  FoxgloveSession(web::Socket& socket, std::string_view server);

  /// From now on the client sees this source: what was advertised goes, and the new topics come. A
  /// recording is played from its beginning.
  void show(std::shared_ptr<Source> source);
  void received(std::string_view text);
  /// What a client publishes, and calls of services.
  void received_binary();
  /// Sends what is due, at most kMaxHz times a second and only once what was sent before is on its
  /// way; called more often. `frames`: messages of this tick that others were sent.
  void tick(Clock::time_point now, FoxgloveFrames& frames);

  /// Whether something is subscribed that moves.
  [[nodiscard]] bool wants_poses() const;
  /// Sensors that are subscribed, in slots of the source.
  [[nodiscard]] std::vector<LookedAt> looked_at() const;

 private:
  using Kind = FoxgloveTopics::Kind;
  void take(const FoxgloveSubscribe& subscribe);
  void take(const FoxgloveUnsubscribe& unsubscribe);
  void take(const FoxgloveRefused& refused);
  void subscribe(const FoxgloveSubscription& subscription);
  void begin(Kind kind);
  void refuse(std::string_view text);
  void say(std::string text);
  void change_bodies(const std::string& change);
  void send_frame(const PlayState& state, FoxgloveFrames& frames);
  void send_shared(Kind kind, FoxgloveFrames& frames);
  void send_scans();
  void send_robots();
  void send_scene();
  /// How many events may be sent for one time of the run.
  [[nodiscard]] std::size_t events_until(double time_s) const;
  void send_log(double now_s);
  void send_data(Kind kind, double time_s, std::string_view message);
  /// The subscription of a topic there is one of; nothing: none.
  [[nodiscard]] std::optional<std::uint32_t> subscription_of(Kind kind) const;

  web::Socket& socket_;
  std::shared_ptr<Source> source_;  ///< Null: there is none yet.
  std::unique_ptr<Playhead> playhead_;
  std::unique_ptr<Cursor> cursor_;
  std::optional<FoxgloveTopics> topics_;
  std::uint32_t next_channel_ = 1;                         ///< Never the same one twice.
  std::map<std::uint32_t, std::uint32_t> channels_;        ///< By subscription.
  std::map<std::int64_t, nlohmann::ordered_json> bodies_;  ///< Those that stand now.
  std::set<std::int64_t> changed_bodies_;                  ///< That the client has not got.
  bool scene_anew_ = false;
  std::vector<std::optional<std::uint16_t>> told_robots_;  ///< Flags; nothing: is not shown.
  bool robots_anew_ = false;
  std::map<LookedAt, double> told_scans_;  ///< Stamp of what was sent last.
  std::size_t told_events_ = 0;
  std::uint64_t told_bodies_ = 0;
  std::uint64_t picture_ = 0;
  PlayState::Kind told_kind_ = PlayState::Kind::kRunning;
  Clock::time_point next_frame_{};
  Clock::time_point last_time_{};
  bool changed_ = true;
  bool broken_ = false;  ///< The source could not show this moment.
  unsigned refusals_ = 0;
};

}  // namespace rave::gui_server
