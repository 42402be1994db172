// SPDX-License-Identifier: Apache-2.0
#include "page/session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "page/frames.hpp"
#include "page/page_text.hpp"

namespace rave::gui_server {
namespace {

/// Frames that the page has not acknowledged. With more, a slow line would show an older state
/// instead of fewer ones.
constexpr std::size_t kMostOnTheirWay = 2;
/// A page that acknowledges a frame within this time can take more of the past.
constexpr auto kQuick = std::chrono::milliseconds(100);
/// Time of the server for the past of one page in one tick.
constexpr auto kPastTime = std::chrono::milliseconds(4);
/// How often a page receives events and changes of the scene.
constexpr auto kNewsInterval = std::chrono::milliseconds(100);
/// Who sends so much nonsense is not our page.
constexpr unsigned kMostRefusals = 20;
/// From 4000 on close codes belong to the application (RFC 6455, 7.4.2).
constexpr std::uint16_t kBadMessages = 4400;
/// In a frame of a reading the probe of this place in the page's list has the number of a sensor.
constexpr std::uint32_t kFirstProbe = 0xf000;

}  // namespace

Session::Session(web::Socket& socket, SessionCalls calls)
    : socket_(socket),
      calls_(std::move(calls)),
      commands_([this](const PageAnswer& said) { socket_.send_text(payload(answer_text(said))); },
                [this](const CommandMessage& command, const PageAnswer& said) {
                  calls_.commanded(command, said);
                },
                [this](const CommandMessage& give) {
                  return calls_.may_give ? calls_.may_give(give) : Status();
                }) {}

void Session::show(std::shared_ptr<Source> source, const Greeting& greeting, bool same_run,
                   SharedTexts& texts) {
  const PlayState before = told_state_;
  // They refer to the source that goes.
  past_.reset();
  cursor_.reset();
  playhead_.reset();
  source_ = std::move(source);
  commands_.begin(source_, greeting.author);
  playhead_ = source_->open_playhead();
  cursor_ = source_->open_cursor();
  // Before the first time message, which would move the page to the beginning of a replay.
  if (same_run) keep_place(before);
  // In this order: events and leases name robots by their slots in the roster.
  socket_.send_text(payload(hello_text(*source_, greeting)));
  socket_.send_text(texts.scene(source_));
  socket_.send_text(texts.roster(source_));
  socket_.send_text(texts.events(source_));
  told_events_ = source_->events_revision();
  told_bodies_ = source_->bodies_revision();
  // Lower than any revision: the next news has the hosts.
  told_hosts_ = 0;
  send_leases(true);
  told_.clear();
  told_variances_.clear();
  // The slots are others now; the page says again what it looks at.
  look_.readings.clear();
  look_.courses.clear();
  look_.variances.clear();
  map_stream_.look({});
  probes_.clear();
  told_map_names_ = 0;
  changed_ = true;
  past_due_ = true;
  broken_ = false;
  const auto now = Clock::now();
  send_time(playhead_->look(now), now);
}

void Session::set_author(Author author) {
  if (author == commands_.author()) return;
  commands_.set_author(std::move(author));
  // Which leases are those of this page depends on it.
  if (source_) send_leases(true);
}

void Session::keep_place(const PlayState& before) {
  using Do = TransportMessage::Do;
  // The time of a run in progress is the same for all pages.
  if (source_->about().live) return;
  const auto now = Clock::now();
  playhead_->take({Do::kPace, before.pace}, now);
  playhead_->take({Do::kSeek, before.now_s}, now);
  if (before.kind != PlayState::Kind::kRunning) playhead_->take({Do::kPause, 0}, now);
}

void Session::received(std::string_view text) {
  auto message = parse_page_message(text);
  if (!message) {
    answer("message", false, message.error().message);
    const bool cut = ++refusals_ > kMostRefusals;
    calls_.malformed(message.error().message, cut);
    // The answer above goes first, so the page can show why it was closed.
    if (cut) socket_.close(kBadMessages, "too many malformed messages");
    return;
  }
  std::visit([this](const auto& what) { take(what); }, *message);
}

void Session::forget_foreign_sensors() {
  if (!source_) return;
  const auto is_foreign = [this](const LookedAt& looked) {
    // Probes are looked at with a message of their own, which checks the right to them.
    return looked.slot >= source_->robot_count() || probe::is_probe(looked.sensor);
  };
  std::erase_if(look_.readings, is_foreign);
  std::erase_if(look_.courses, is_foreign);
}

void Session::take(const LookMessage& look) {
  const std::vector<LookedAt> before = std::exchange(look_, look).courses;
  pace_.set_rate(look.max_hz);
  forget_foreign_sensors();
  courses_due_ = courses_due_ || !std::ranges::includes(before, look_.courses);
  told_.clear();
  changed_ = true;
}

void Session::take(const LookMapsMessage& look) {
  map_stream_.look(look.maps);
  changed_ = true;
}

void Session::take(const LookProbesMessage& look) {
  probes_.clear();
  std::vector<ProbeAnswer> answers;
  for (std::uint32_t place = 0; place < look.probes.size(); ++place) {
    ProbeAnswer& answer = answers.emplace_back();
    answer.slot = look.probes[place].slot;
    if (!source_) {
      answer.error = "No run is in progress.";
      // Each probe is read and made once here to find its errors, which takes time of the server.
    } else if (!probe_limit_.take(Clock::now())) {
      answer.error = "Too many changes at once. Try again in a second.";
    } else if (auto made = source_->probe(look.probes[place]); !made) {
      answer.error = made.error().message;
    } else {
      answer.made = *made;
      probes_.push_back({answer.slot, place, std::move(made->asked)});
    }
  }
  socket_.send_text(payload(probes_text(look.request, answers)));
  changed_ = true;
}

void Session::take(const AskCatalogueMessage& ask) {
  const std::string drivers = source_ ? source_->virtual_sensors_json() : "[]";
  socket_.send_text(payload(R"({"type":"catalogue","request":)" + std::to_string(ask.request) +
                            R"(,"drivers":)" + drivers + "}"));
}

void Session::take(const AckMessage& ack) {
  // A frame that was drawn says that those before it were drawn or left out.
  while (!on_their_way_.empty() &&
         static_cast<std::int32_t>(on_their_way_.front().first - ack.sequence) <= 0) {
    // The past grows while the line keeps up and shrinks at once when it does not: the frame of the
    // moment must never queue behind it.
    const bool quick = Clock::now() - on_their_way_.front().second < kQuick;
    past_bytes_ = quick ? std::min(2 * past_bytes_, kMostPast) : kLeastPast;
    on_their_way_.pop_front();
  }
}

void Session::take(const TransportMessage& transport) {
  if (!playhead_) return answer("transport", false, "No run is in progress.");
  const auto now = Clock::now();
  if (const std::string why_not = playhead_->take(transport, now); !why_not.empty()) {
    return answer("transport", false, why_not);
  }
  changed_ = true;
  broken_ = false;
  const PlayState state = playhead_->look(now);
  past_due_ = past_due_ || state.jumped;
  if (past_due_) told_.clear();
  send_time(state, now);
}

void Session::take(const HaltMessage& halt) {
  const char* const to = halt.stop ? "stop" : "release";
  if (!source_) return answer(to, false, "No run is in progress.");
  source_->halt(
      halt, commands_.author(),
      [this, to, halt, alive = std::weak_ptr(alive_)](bool good, const std::string& text) {
        // The answer of the run may come after the page has gone.
        if (alive.expired()) return;
        answer(to, good, text);
        calls_.halted(halt, good);
      });
}

void Session::take(const ChatMessage& chat) {
  const auto done = calls_.chat(chat);
  socket_.send_text(payload(answer_text(
      {"say", done.has_value(), done ? *done : done.error().message, chat.request, {}})));
}

void Session::take(const SetRightMessage& set) {
  const auto done = calls_.set_right(set.change);
  answer("set_right", done.has_value(), done ? *done : done.error().message);
}

void Session::take(const SeeAsMessage& see) {
  const auto done = calls_.see_as(see);
  answer("see_as", done.has_value(), done ? *done : done.error().message);
}

void Session::tick(Clock::time_point now, SharedFrames& frames) {
  if (!source_) return;
  const PlayState state = playhead_->look(now);
  if (state.jumped) {
    past_due_ = true;
    told_.clear();
  }
  const bool differs = state.kind != told_state_.kind || state.pace != told_state_.pace ||
                       state.reason != told_state_.reason;
  if (differs) changed_ = true;
  if (differs || now - last_time_ >= std::chrono::seconds(1)) send_time(state, now);
  if (now - last_news_ >= kNewsInterval) {
    last_news_ = now;
    send_news();
  }
  if (!look_.poses || broken_ || on_their_way_.size() >= kMostOnTheirWay) return;
  // Tiles are confirmed by the picture behind them.
  if (map_stream_.due(*source_)) changed_ = true;
  // While the past is being sent, frames continue without a new picture: each acknowledgement asks
  // for the next piece.
  const bool due = pace_.due(now, state.picture) && (state.picture != picture_ || past_);
  if (!due && !changed_) return;
  pace_.went(now);
  if (const auto gone = cursor_->go_to(state.now_s); !gone) {
    answer("replay", false, gone.error().text());
    // A damaged recording would give the same error in each tick. The next transport message tries
    // again.
    broken_ = true;
    return;
  }
  if (auto bodies = cursor_->take_bodies(); !bodies.empty()) {
    socket_.send_text(payload(std::move(bodies)));
  }
  send_readings();
  send_probes();
  send_variances();
  map_stream_.send(*source_,
                   [this](std::string tile) { socket_.send_binary(payload(std::move(tile))); });
  send_frame(frames);
  picture_ = state.picture;
  changed_ = false;
  // A run in progress keeps poses, but no readings.
  if (past_due_ || (courses_due_ && !source_->about().live)) begin_past(state.now_s);
  send_past();
}

void Session::begin_past(double now_s) {
  PastStream::Wanted wanted{past_due_ || (past_ && past_->has_poses()), {}, look_.parts};
  if (!source_->about().live) wanted.readings = look_.courses;
  past_due_ = courses_due_ = false;
  past_.emplace(source_->open_cursor(), now_s, std::move(wanted));
}

/// Pieces of the past go behind frames, whose acknowledgements tell how much the line takes. The
/// frame of the moment does not wait for it.
void Session::send_past() {
  const auto send = [this](std::string frame) { socket_.send_binary(payload(std::move(frame))); };
  if (past_ && !past_->send(past_bytes_, kPastTime, sequence_, send)) past_.reset();
}

void Session::send_frame(SharedFrames& frames) {
  const PosesAt& poses = cursor_->poses();
  // Without a serial the moment belongs to this page alone, as in a replay.
  const std::uint32_t sequence = poses.serial == 0 ? sequence_ + 1 : poses.serial;
  sequence_ = sequence;
  if (look_.true_poses && !poses.truth.empty()) send_poses(frames, sequence, true);
  send_poses(frames, sequence, false);
  on_their_way_.emplace_back(sequence, Clock::now());
}

void Session::send_poses(SharedFrames& frames, std::uint32_t sequence, bool truth) {
  const PosesAt& poses = cursor_->poses();
  PoseFrameHead head;
  head.sequence = sequence;
  head.truth = truth;
  web::Payload own;
  // One encoding serves all pages of the same rights.
  web::Payload& frame = poses.serial == 0 ? own : frames[{source_.get(), poses.serial, truth}];
  if (!frame) frame = payload(encode_poses(poses, head));
  socket_.send_binary(frame);
}

void Session::send_readings() {
  if (look_.readings.empty()) return;
  for (const ReadingAt& reading : cursor_->readings(look_.readings, look_.parts)) {
    const auto [told, is_new] =
        told_.try_emplace({LookedAt{reading.slot, reading.sensor}, reading.part}, reading.stamp_s);
    // The stamp names the reading. In a paused replay or between two samples of a slow sensor
    // nothing is sent.
    if (!is_new && told->second == reading.stamp_s) continue;
    told->second = reading.stamp_s;
    socket_.send_binary(payload(encode_reading(reading, cursor_->poses().time_s)));
  }
}

void Session::send_probes() {
  if (probes_.empty()) return;
  std::vector<LookedAt> looked;
  for (const ProbeShown& probe : probes_) looked.push_back({probe.slot, probe.asked.number});
  for (ReadingAt& reading : cursor_->readings(looked, false)) {
    const auto probe = std::find_if(probes_.begin(), probes_.end(), [&](const ProbeShown& one) {
      return one.slot == reading.slot && one.asked.number == reading.sensor;
    });
    if (probe == probes_.end() || probe->told_s == reading.stamp_s) continue;
    probe->told_s = reading.stamp_s;
    reading.sensor = kFirstProbe + probe->place;
    socket_.send_binary(payload(encode_reading(reading, cursor_->poses().time_s)));
  }
}

/// Of the robots that the page names, when they change. Who may not see a robot has no pose of it,
/// and so no variance.
void Session::send_variances() {
  const PosesAt& poses = cursor_->poses();
  std::vector<VarianceAt> variances;
  for (const std::uint32_t slot : look_.variances) {
    // The list is sorted, so all further slots are too large as well.
    if (slot >= poses.robots.size()) break;
    const RobotState& robot = poses.robots[slot];
    if (robot.variance_xy_m2 <= 0 && robot.variance_yaw_rad2 <= 0) continue;
    variances.push_back({slot, robot.variance_xy_m2, robot.variance_yaw_rad2});
  }
  if (variances == told_variances_) return;
  socket_.send_binary(payload(encode_variances(variances, poses.time_s)));
  told_variances_ = std::move(variances);
}

void Session::send_news() {
  if (const std::uint64_t revision = source_->events_revision(); revision != told_events_) {
    const std::size_t first = source_->events_changed_since(told_events_);
    told_events_ = revision;
    if (first < source_->events().size()) {
      socket_.send_text(payload(events_text(source_->events(), first)));
    }
  }
  if (const std::uint64_t revision = source_->bodies_revision(); revision != told_bodies_) {
    if (auto change = source_->bodies_changed_since(told_bodies_); !change.empty()) {
      socket_.send_text(payload(std::move(change)));
    }
    told_bodies_ = revision;
  }
  if (const std::uint64_t revision = source_->hosts_revision(); revision != told_hosts_) {
    socket_.send_text(payload(R"({"type":"hosts","hosts":)" + source_->hosts_json() + "}"));
    told_hosts_ = revision;
  }
  if (source_->leases_revision() != told_leases_) send_leases(false);
  if (const std::uint64_t revision = source_->map_names_revision(); revision != told_map_names_) {
    told_map_names_ = revision;
    socket_.send_text(payload(maps_text(source_->map_names())));
  }
}

void Session::send_leases(bool all) {
  const std::uint64_t since = all ? 0 : told_leases_;
  told_leases_ = source_->leases_revision();
  const std::vector<DriveState> changed = source_->leases_changed_since(since);
  if (!all && changed.empty()) return;
  socket_.send_text(payload(leases_text(changed, commands_.author(), all)));
}

void Session::send_time(const PlayState& state, Clock::time_point now) {
  last_time_ = now;
  told_state_ = state;
  socket_.send_text(payload(time_text(state, source_->about())));
}

void Session::answer(std::string_view to, bool good, std::string_view text) {
  socket_.send_text(payload(answer_text({std::string(to), good, std::string(text), {}, {}})));
}

}  // namespace rave::gui_server
