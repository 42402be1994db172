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
constexpr double kPast_s = 20;
constexpr double kPastSpacing_s = 0.2;
constexpr double kSlowest = 1.0 / 64;
constexpr double kFastest = 64;
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

std::string hello_text(const RunAbout& about, const std::string& user) {
  Json recording = nullptr;
  if (!about.recording.empty()) {
    recording = {{"name", about.recording.filename().string()},
                 {"bytes", about.recording_bytes},
                 {"whole", about.recording_whole}};
  }
  const Json hello = {
      {"type", "hello"},
      {"protocol", 1},
      {"server", "rave"},
      {"run",
       {{"name", about.name},
        {"source", "replay"},
        {"clock", about.lock_step ? "lock_step" : "real_time"},
        {"started", about.started},
        {"step_s", about.step_s},
        {"seed", about.seed},
        {"hash", about.hash.empty() ? Json(nullptr) : Json(about.hash)},
        {"recording", std::move(recording)}}},
      {"user", {{"name", user}, {"role", "super_user"}}},
      {"may", {"play", "seek", "pace", "step", "readings", "obstacles", "log", "recording"}},
      {"why_not",
       {{"stop", "A recording cannot be stopped."},
        {"release", "A recording cannot be released."},
        {"true_pose", "This view shows reported poses."},
        {"hybrid_parts", "This view shows what programs were given."}}}};
  return hello.dump();
}

std::string events_text(std::span<const LogEvent> events) {
  Json message = {{"type", "events"}, {"reset", true}, {"first", 0}, {"events", Json::array()}};
  for (const LogEvent& event : events) {
    message["events"].push_back({{"t", event.t_s},
                                 {"until", event.until_s},
                                 {"count", event.count},
                                 {"kind", event.kind},
                                 {"level", level_word(event.level)},
                                 {"text", event.text},
                                 {"slots", event.slots}});
  }
  return message.dump();
}

}  // namespace

Session::Session(web::Socket& socket, Source& source, std::string user)
    : socket_(socket), source_(source), user_(std::move(user)), cursor_(source.open_cursor()) {
  since_ = Clock::now();
  at_s_ = source_.about().begin_s;
  begin();
}

void Session::begin() {
  socket_.send_text(payload(hello_text(source_.about(), user_)));
  socket_.send_text(
      payload(R"({"type":"scene","hidden":[],"bodies":)" + source_.bodies_json() + "}"));
  socket_.send_text(
      payload(R"({"type":"roster","revision":1,"robots":)" + source_.robots_json() + "}"));
  socket_.send_text(payload(events_text(source_.events())));
  go_to(at_s_);
  send_time();
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

void Session::take(const LookMessage& look) {
  look_ = look;
  std::erase_if(look_.readings,
                [this](const LookedAt& looked) { return looked.slot >= source_.robot_count(); });
  told_.clear();
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
  using Do = TransportMessage::Do;
  const auto now = Clock::now();
  const RunAbout& about = source_.about();
  at_s_ = due_s(now);
  since_ = now;
  switch (transport.what) {
    case Do::kPlay:
      running_ = true;
      // At the end, play begins anew.
      if (at_s_ >= about.end_s) go_to(about.begin_s);
      break;
    case Do::kPause:
      running_ = false;
      break;
    case Do::kStep:
      running_ = false;
      go_to(cursor_->poses().time_s + std::round(transport.value) * about.step_s);
      break;
    case Do::kSeek:
      go_to(transport.value);
      break;
    case Do::kPace:
      pace_ = std::clamp(transport.value, kSlowest, kFastest);
      break;
  }
  send_time();
}

void Session::take(const HaltMessage& halt) {
  answer(halt.stop ? "stop" : "release", false, "A recording cannot be stopped.");
}

double Session::due_s(Clock::time_point now) const {
  if (!running_) return at_s_;
  const double gone_s = std::chrono::duration<double>(now - since_).count();
  return std::min(at_s_ + pace_ * gone_s, source_.about().end_s);
}

void Session::go_to(double time_s) {
  const RunAbout& about = source_.about();
  const double before_s = cursor_->poses().time_s;
  at_s_ = std::clamp(time_s, about.begin_s, about.end_s);
  since_ = Clock::now();
  if (at_s_ < before_s || at_s_ > before_s + 1) past_due_ = true;
  if (past_due_) told_.clear();
  changed_ = true;
}

void Session::tick(Clock::time_point now) {
  const double due = due_s(now);
  if (running_ && due >= source_.about().end_s) {
    at_s_ = due;
    running_ = false;
    changed_ = true;
    send_time();
  }
  if (now - last_time_ >= std::chrono::seconds(1)) send_time();
  if (!look_.poses || on_their_way_.size() >= kMostOnTheirWay) return;
  if (!running_ && !changed_) return;
  const auto spacing = std::chrono::duration<double>(0.9 / look_.max_hz);
  if (now - last_frame_ < spacing && !changed_) return;
  last_frame_ = now;
  if (past_due_) send_past();
  if (const auto gone = cursor_->go_to(due); !gone) {
    answer("replay", false, gone.error().text());
    running_ = false;
    changed_ = false;
    return;
  }
  send_readings();
  send_frame();
  changed_ = false;
}

void Session::send_past() {
  past_due_ = false;
  const double now_s = due_s(Clock::now());
  const double begin_s = std::max(source_.about().begin_s, now_s - kPast_s);
  for (double t = begin_s; t < now_s - kPastSpacing_s / 2; t += kPastSpacing_s) {
    if (!cursor_->go_to(t)) return;
    PoseFrameHead head;
    head.sequence = ++sequence_;
    head.roster_revision = 1;
    head.past = true;
    socket_.send_binary(payload(encode_poses(cursor_->poses(), head)));
  }
}

void Session::send_frame() {
  PoseFrameHead head;
  head.sequence = ++sequence_;
  head.roster_revision = 1;
  on_their_way_.push_back(head.sequence);
  socket_.send_binary(payload(encode_poses(cursor_->poses(), head)));
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

void Session::send_time() {
  last_time_ = Clock::now();
  const RunAbout& about = source_.about();
  const double now_s = due_s(last_time_);
  const bool at_end = !running_ && now_s >= about.end_s;
  const Json time = {{"type", "time"},
                     {"now_s", now_s},
                     {"step", std::llround(now_s / about.step_s)},
                     {"begin_s", about.begin_s},
                     {"end_s", about.end_s},
                     {"duration_s", about.duration_s},
                     {"state", running_ ? "running" : (at_end ? "ended" : "paused")},
                     {"reason", ""},
                     {"pace", pace_},
                     {"speed", running_ ? pace_ : 0.0}};
  socket_.send_text(payload(time.dump()));
}

void Session::answer(std::string_view to, bool good, std::string_view text) {
  const Json message = {{"type", "answer"}, {"to", to}, {"good", good}, {"text", text}};
  // What a page sent may stand in the text; what is no UTF-8 is replaced.
  socket_.send_text(payload(message.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

}  // namespace rave::gui_server
