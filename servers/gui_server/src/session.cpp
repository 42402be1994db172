// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "frames.hpp"

namespace rave::gui_server {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostOnTheirWay = 2;
/// How often a page is told what happened, and what came and went.
constexpr auto kNewsInterval = std::chrono::milliseconds(100);
/// Who sends so much nonsense is not our page.
constexpr unsigned kMostRefusals = 20;
constexpr std::uint16_t kBadMessages = 4400;

web::Payload payload(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

const char* level_word(LogEvent::Level level) {
  switch (level) {
    case LogEvent::Level::kInfo:
      return "info";
    case LogEvent::Level::kWarn:
      return "warn";
    case LogEvent::Level::kAlert:
      return "alert";
  }
  return "info";
}

const char* state_word(PlayState::Kind kind) {
  switch (kind) {
    case PlayState::Kind::kRunning:
      return "running";
    case PlayState::Kind::kPaused:
      return "paused";
    case PlayState::Kind::kWaiting:
      return "waiting";
    case PlayState::Kind::kEnded:
      return "ended";
  }
  return "ended";
}

Json person_json(const Person& person) {
  return {{"name", person.name}, {"role", to_string(person.role)}};
}

std::string hello_text(const Source& source, const Greeting& greeting) {
  const RunAbout& about = source.about();
  Json recording = nullptr;
  if (!about.recording.empty()) {
    recording = {{"name", about.recording.filename().string()},
                 {"bytes", about.recording_bytes},
                 {"whole", about.recording_whole}};
  }
  Powers powers = source.powers();
  if (greeting.user.role == Role::kSuperUser && !greeting.seen_by)
    powers.may.emplace_back("rights");
  Json hello = {{"type", "hello"},
                {"protocol", 1},
                {"server", "rave"},
                {"run",
                 {{"name", about.name},
                  {"source", about.live ? "live" : "replay"},
                  {"clock", about.lock_step ? "lock_step" : "real_time"},
                  {"started", about.started},
                  {"step_s", about.step_s},
                  {"seed", about.seed},
                  {"hash", about.hash.empty() ? Json(nullptr) : Json(about.hash)},
                  {"recording", std::move(recording)}}},
                {"user", person_json(greeting.user)},
                {"may", powers.may},
                {"why_not", powers.why_not}};
  if (greeting.seen_by) hello["seen_by"] = person_json(*greeting.seen_by);
  return hello.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Events from `first` on; with 0 the page forgets those that it had.
std::string events_text(std::span<const LogEvent> events, std::size_t first) {
  Json message = {
      {"type", "events"}, {"reset", first == 0}, {"first", first}, {"events", Json::array()}};
  for (const LogEvent& event : events.subspan(first)) {
    message["events"].push_back({{"t", event.t_s},
                                 {"until", event.until_s},
                                 {"count", event.count},
                                 {"kind", event.kind},
                                 {"level", level_word(event.level)},
                                 {"text", event.text},
                                 {"slots", event.slots}});
  }
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Session::Session(web::Socket& socket, SessionCalls calls)
    : socket_(socket), calls_(std::move(calls)) {}

void Session::show(std::shared_ptr<Source> source, const Greeting& greeting, bool same_run) {
  const PlayState before = told_state_;
  // They refer to the source that goes.
  cursor_.reset();
  playhead_.reset();
  source_ = std::move(source);
  playhead_ = source_->open_playhead();
  cursor_ = source_->open_cursor();
  if (same_run) keep_place(before);
  socket_.send_text(payload(hello_text(*source_, greeting)));
  socket_.send_text(payload(R"({"type":"scene","hidden":)" + source_->hidden_kinds_json() +
                            R"(,"bodies":)" + source_->bodies_json() + "}"));
  socket_.send_text(
      payload(R"({"type":"roster","revision":1,"robots":)" + source_->robots_json() + "}"));
  socket_.send_text(payload(events_text(source_->events(), 0)));
  told_events_ = source_->events_revision();
  told_bodies_ = source_->bodies_revision();
  told_hosts_ = 0;
  told_.clear();
  told_variances_.clear();
  // The slots are others now; the page says again what it looks at.
  look_.readings.clear();
  changed_ = true;
  past_due_ = true;
  broken_ = false;
  send_time(playhead_->look(Clock::now()));
}

void Session::keep_place(const PlayState& before) {
  using Do = TransportMessage::Do;
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
    if (++refusals_ > kMostRefusals) socket_.close(kBadMessages, "too many malformed messages");
    return;
  }
  std::visit([this](const auto& what) { take(what); }, *message);
}

void Session::forget_foreign_sensors() {
  if (!source_) return;
  std::erase_if(look_.readings,
                [this](const LookedAt& looked) { return looked.slot >= source_->robot_count(); });
}

void Session::take(const LookMessage& look) {
  look_ = look;
  forget_foreign_sensors();
  told_.clear();
  told_variances_.clear();
  changed_ = true;
}

void Session::take(const AckMessage& ack) {
  // A frame that was drawn says that those before it were drawn or left out.
  while (!on_their_way_.empty() &&
         static_cast<std::int32_t>(on_their_way_.front() - ack.sequence) <= 0) {
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
  send_time(state);
}

void Session::take(const HaltMessage& halt) {
  const char* const to = halt.stop ? "stop" : "release";
  if (!source_) return answer(to, false, "No run is in progress.");
  source_->halt(
      halt, [this, to, halt, alive = std::weak_ptr(alive_)](bool good, const std::string& text) {
        if (alive.expired()) return;
        answer(to, good, text);
        calls_.halted(halt, good);
      });
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
  if (differs || now - last_time_ >= std::chrono::seconds(1)) send_time(state);
  if (now - last_news_ >= kNewsInterval) {
    last_news_ = now;
    send_news();
  }
  if (!look_.poses || broken_ || on_their_way_.size() >= kMostOnTheirWay) return;
  if (state.picture == picture_ && !changed_) return;
  const auto spacing = std::chrono::duration<double>(0.9 / look_.max_hz);
  if (now - last_frame_ < spacing && !changed_) return;
  last_frame_ = now;
  if (past_due_) send_past(state.now_s);
  if (const auto gone = cursor_->go_to(state.now_s); !gone) {
    answer("replay", false, gone.error().text());
    broken_ = true;
    return;
  }
  if (auto bodies = cursor_->take_bodies(); !bodies.empty()) {
    socket_.send_text(payload(std::move(bodies)));
  }
  send_readings();
  send_variances();
  send_frame(frames);
  picture_ = state.picture;
  changed_ = false;
}

void Session::send_past(double now_s) {
  past_due_ = false;
  for (double t = now_s - kPast_s; t < now_s - kPastSpacing_s / 2; t += kPastSpacing_s) {
    if (t < 0) continue;
    if (!cursor_->go_to(t)) return;
    if (cursor_->poses().robots.empty() || cursor_->poses().time_s > t + kPastSpacing_s) continue;
    PoseFrameHead head;
    head.sequence = ++sequence_;
    head.roster_revision = 1;
    head.past = true;
    socket_.send_binary(payload(encode_poses(cursor_->poses(), head)));
  }
}

void Session::send_frame(SharedFrames& frames) {
  const PosesAt& poses = cursor_->poses();
  PoseFrameHead head;
  head.roster_revision = 1;
  if (poses.serial == 0) {
    head.sequence = ++sequence_;
    socket_.send_binary(payload(encode_poses(poses, head)));
  } else {
    // One encoding serves all pages of the same rights.
    head.sequence = sequence_ = poses.serial;
    web::Payload& frame = frames[{source_.get(), poses.serial}];
    if (!frame) frame = payload(encode_poses(poses, head));
    socket_.send_binary(frame);
  }
  on_their_way_.push_back(head.sequence);
}

void Session::send_readings() {
  if (look_.readings.empty()) return;
  for (const ReadingAt& reading : cursor_->readings(look_.readings, look_.parts)) {
    const auto [told, is_new] =
        told_.try_emplace({LookedAt{reading.slot, reading.sensor}, reading.part}, reading.stamp_s);
    if (!is_new && told->second == reading.stamp_s) continue;
    told->second = reading.stamp_s;
    socket_.send_binary(payload(encode_reading(reading, cursor_->poses().time_s)));
  }
}

/// Of the robots whose readings are looked at, when they change.
void Session::send_variances() {
  const PosesAt& poses = cursor_->poses();
  std::vector<VarianceAt> variances;
  for (const LookedAt& looked : look_.readings) {
    if (looked.slot >= poses.robots.size()) continue;
    if (!variances.empty() && variances.back().slot == looked.slot) continue;
    const RobotState& robot = poses.robots[looked.slot];
    if (robot.variance_xy_m2 <= 0 && robot.variance_yaw_rad2 <= 0) continue;
    variances.push_back({looked.slot, robot.variance_xy_m2, robot.variance_yaw_rad2});
  }
  if (variances == told_variances_) return;
  socket_.send_binary(payload(encode_variances(variances, poses.time_s, 1)));
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
}

void Session::send_time(const PlayState& state) {
  last_time_ = Clock::now();
  told_state_ = state;
  const Json time = {{"type", "time"},
                     {"now_s", state.now_s},
                     {"step", std::llround(state.now_s / source_->about().step_s)},
                     {"begin_s", state.begin_s},
                     {"end_s", state.end_s},
                     {"duration_s", state.duration_s},
                     {"state", state_word(state.kind)},
                     {"reason", state.reason},
                     {"pace", state.pace},
                     {"speed", state.speed}};
  socket_.send_text(payload(time.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

void Session::answer(std::string_view to, bool good, std::string_view text) {
  const Json message = {{"type", "answer"}, {"to", to}, {"good", good}, {"text", text}};
  // What a page sent may stand in the text; what is no UTF-8 is replaced.
  socket_.send_text(payload(message.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

}  // namespace rave::gui_server
