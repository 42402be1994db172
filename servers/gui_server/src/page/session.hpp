// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "page/frame_pace.hpp"
#include "page/frames.hpp"
#include "page/map_stream.hpp"
#include "page/page_commands.hpp"
#include "page/page_message.hpp"
#include "page/page_text.hpp"
#include "page/past_stream.hpp"
#include "page/shared_texts.hpp"
#include "rave/base/token_bucket.hpp"
#include "rave/gui_server/person.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// Frames of a tick that several pages are sent, by source, serial number of the picture, and
/// whether it has true poses.
using SharedFrames = std::map<std::tuple<const Source*, std::uint32_t, bool>, web::Payload>;

/// What a session asks of its server: each returns a sentence, or an error that the page receives.
struct SessionCalls {
  std::function<Result<std::string>(const RightChange&)> set_right;
  std::function<Result<std::string>(const SeeAsMessage&)> see_as;
  /// Before an answer to stop or release is sent.
  std::function<void(const HaltMessage&, bool good)> halted;
  /// Once it is known what became of it.
  PageCommands::Told commanded;
  PageCommands::MayGive may_give;
  std::function<Result<std::string>(const ChatMessage&)> chat;
  /// A message that is none. `cut`: it is one too many, and the page is cut off.
  std::function<void(std::string_view why, bool cut)> malformed;
  /// The page has a key, so it is known from now on by that.
  std::function<void(const PageKeyMessage&)> page_key;
  /// Answers by itself.
  std::function<void(const PeopleMessage&)> people;
  /// Answers by itself.
  std::function<void(const ConductMessage&)> conduct;
};

/// A virtual sensor that a page tries.
struct ProbeShown {
  std::uint32_t slot = 0;   ///< Of the page.
  std::uint32_t place = 0;  ///< In the page's list.
  probe::Asked asked;
  double told_s = -1;  ///< Stamp of the reading that was sent last.
};

/// One page that is connected: what it looks at, its place in time, what is on its way to it. The
/// thread of the server.
class Session {
 public:
  using Clock = Playhead::Clock;
  /// Each that is made costs some of the server's time.
  static constexpr double kProbesPerSecond = 10;
  static constexpr double kProbesAtOnce = 40;
  /// Bytes of the past behind one frame: at first, or over a slow line, and at most. Whatever waits
  /// on a slow line makes the frames behind it old.
  static constexpr std::size_t kLeastPast = std::size_t{8} << 10U;
  static constexpr std::size_t kMostPast = std::size_t{512} << 10U;

  /// `socket` outlives the session, and what `calls` use as well.
  Session(web::Socket& socket, SessionCalls calls);

  /// From now on the page sees this source: hello, and all that does not change. `same_run`: it is
  /// the same run with other rights, so the page stays where it is in time. `texts`: of all pages.
  void show(std::shared_ptr<Source> source, const Greeting& greeting, bool same_run,
            SharedTexts& texts);
  void send(web::Payload text) { socket_.send_text(std::move(text)); }
  /// The same person has other rights.
  void set_author(Author author);
  /// Asks of robots as if the page had, as what is said to a robot does.
  void command(const CommandMessage& command) { commands_.take(command); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { commands_.let_go(); }
  void received(std::string_view text);
  /// Sends what is due; called 25 to 60 times a second. `frames`: those of this tick that other
  /// pages were sent.
  void tick(Clock::time_point now, SharedFrames& frames);
  [[nodiscard]] const LookMessage& look() const noexcept { return look_; }
  /// Maps that the page shows, by its slots; empty while it shows no run.
  [[nodiscard]] std::span<const MapName> looked_at_maps() const noexcept {
    return look_.poses ? std::span<const MapName>(map_stream_.looked_at())
                       : std::span<const MapName>();
  }
  /// Virtual sensors that the page tries, by robots of the run; none while it shows no run.
  [[nodiscard]] std::span<const ProbeShown> looked_at_probes() const noexcept {
    return look_.poses ? std::span<const ProbeShown>(probes_) : std::span<const ProbeShown>();
  }

 private:
  void take(const LookMessage& look);
  void take(const LookMapsMessage& look);
  void take(const LookProbesMessage& look);
  void take(const AskCatalogueMessage& ask);
  void take(const AckMessage& ack);
  void take(const TransportMessage& transport);
  void take(const HaltMessage& halt);
  void take(const SetRightMessage& set);
  void take(const SeeAsMessage& see);
  void take(const CommandMessage& command) { commands_.take(command); }
  void take(const ChatMessage& chat);
  void take(const PeopleMessage& people) { calls_.people(people); }
  void take(const ConductMessage& conduct) { calls_.conduct(conduct); }
  void take(const PageKeyMessage& page) { calls_.page_key(page); }
  void keep_place(const PlayState& before);
  void forget_foreign_sensors();
  void begin_past(double now_s);
  void send_past();
  void send_frame(SharedFrames& frames);
  void send_poses(SharedFrames& frames, std::uint32_t sequence, bool truth);
  void send_readings();
  void send_probes();
  void send_variances();
  void send_time(const PlayState& state, Clock::time_point now);
  void send_news();
  void send_leases(bool all);
  void answer(std::string_view to, bool good, std::string_view text);

  web::Socket& socket_;
  SessionCalls calls_;
  PageCommands commands_;
  std::shared_ptr<Source> source_;  ///< Null: there is none yet.
  std::unique_ptr<Playhead> playhead_;
  std::unique_ptr<Cursor> cursor_;
  LookMessage look_;
  PlayState told_state_;  ///< As the page knows it.
  FramePace pace_;
  Clock::time_point last_time_{};
  Clock::time_point last_news_{};
  std::uint32_t sequence_ = 0;
  /// Frames that are not acknowledged: their number, and when they were sent.
  std::deque<std::pair<std::uint32_t, Clock::time_point>> on_their_way_;
  std::optional<PastStream> past_;       ///< As far as it has not been sent.
  std::size_t past_bytes_ = kLeastPast;  ///< Of the past, behind the next frame.
  std::map<std::pair<LookedAt, std::uint8_t>, double> told_;  ///< Stamp of what was sent last.
  std::vector<VarianceAt> told_variances_;
  MapStream map_stream_;
  std::vector<ProbeShown> probes_;
  TokenBucket probe_limit_{kProbesPerSecond, kProbesAtOnce};
  std::uint64_t told_map_names_ = 0;
  std::uint64_t told_events_ = 0;
  std::uint64_t told_bodies_ = 0;
  std::uint64_t told_hosts_ = 0;
  std::uint64_t told_leases_ = 0;
  std::uint64_t picture_ = 0;  ///< Of the last frame.
  bool changed_ = true;        ///< Something is to be shown that has not been sent.
  bool past_due_ = true;       ///< The page has no past to draw trails with.
  bool courses_due_ = false;   ///< The page has no past readings of `look_.courses`.
  bool broken_ = false;        ///< The source could not show this moment.
  unsigned refusals_ = 0;
  std::shared_ptr<const bool> alive_ =
      std::make_shared<bool>(true);  ///< For answers that come late.
};

}  // namespace rave::gui_server
