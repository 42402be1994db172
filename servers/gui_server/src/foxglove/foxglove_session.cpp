// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "foxglove/foxglove_scene.hpp"
#include "page/page_text.hpp"

namespace rave::gui_server {
namespace {

constexpr auto kFoxgloveSpacing =
    std::chrono::microseconds(static_cast<std::int64_t>(1e6 / FoxgloveSession::kMaxHz));
constexpr auto kFoxgloveClock = std::chrono::seconds(1);
/// Limit of earlier events for a client that subscribes.
constexpr std::size_t kMostPastEvents = 200;
/// Who sends so much nonsense is no Foxglove client.
constexpr unsigned kMostFoxgloveRefusals = 100;
constexpr std::uint16_t kFoxgloveNonsense = 4400;
/// Of the flags, those that a robot shows by its colour.
constexpr std::uint16_t kShownFlags = kStale | kStopped;

}  // namespace

FoxgloveSession::FoxgloveSession(web::Socket& socket, std::string_view server) : socket_(socket) {
  say(foxglove_server_info("rave", server));
  say(foxglove_advertise({}));
}

void FoxgloveSession::say(std::string text) { socket_.send_text(payload(std::move(text))); }

void FoxgloveSession::refuse(std::string_view text) {
  if (++refusals_ > kMostFoxgloveRefusals) {
    return socket_.close(kFoxgloveNonsense, "too many refused messages");
  }
  say(foxglove_status(FoxgloveLevel::kError, text));
}

void FoxgloveSession::show(std::shared_ptr<Source> source) {
  if (topics_) say(foxglove_unadvertise(topics_->channels()));
  // They refer to the source that goes.
  cursor_.reset();
  playhead_.reset();
  channels_.clear();
  source_ = std::move(source);
  playhead_ = source_->open_playhead();
  cursor_ = source_->open_cursor();
  if (!source_->about().live) playhead_->take({TransportMessage::Do::kPlay, 0}, Clock::now());
  // Numbers of channels are not used again: a client may still name one of the run before.
  topics_.emplace(*source_, next_channel_);
  next_channel_ += static_cast<std::uint32_t>(topics_->topics().size());
  bodies_.clear();
  for (auto& body : nlohmann::ordered_json::parse(source_->bodies_json())) {
    const auto id = body.at("id").get<std::int64_t>();
    bodies_[id] = std::move(body);
  }
  told_bodies_ = source_->bodies_revision();
  told_scans_.clear();
  changed_ = true;
  broken_ = false;
  say(foxglove_advertise(topics_->channels()));
  if (topics_->left_out() > 0) {
    say(foxglove_status(FoxgloveLevel::kWarning,
                        fmt::format("{} range sensors have no topic: there are more than {}",
                                    topics_->left_out(), kMostScans)));
  }
}

void FoxgloveSession::received(std::string_view text) {
  const auto message = parse_foxglove_message(text);
  if (!message) return refuse(message.error().message);
  std::visit([this](const auto& what) { take(what); }, *message);
}

void FoxgloveSession::received_binary() {
  refuse("read-only: clients cannot publish, and there are no services");
}

void FoxgloveSession::take(const FoxgloveSubscribe& subscribe_to) {
  for (const FoxgloveSubscription& one : subscribe_to.subscriptions) subscribe(one);
}

void FoxgloveSession::subscribe(const FoxgloveSubscription& subscription) {
  const auto* const topic = topics_ ? topics_->topic_of(subscription.channel) : nullptr;
  if (topic == nullptr) {
    return refuse(fmt::format("there is no channel {}", subscription.channel));
  }
  const bool taken = channels_.contains(subscription.id) ||
                     std::ranges::any_of(channels_, [&subscription](const auto& known) {
                       return known.second == subscription.channel;
                     });
  if (taken) {
    return refuse(fmt::format("subscription {}: this number or channel is already subscribed",
                              subscription.id));
  }
  channels_[subscription.id] = subscription.channel;
  // The newest scan is sent even if an earlier subscription had it.
  if (topic->kind == Kind::kScan) told_scans_.erase(topic->sensor);
  begin(topic->kind);
  changed_ = true;
}

void FoxgloveSession::begin(Kind kind) {
  if (kind == Kind::kScene) {
    scene_anew_ = true;
  } else if (kind == Kind::kRobots) {
    robots_anew_ = true;
  } else if (kind == Kind::kLog) {
    const std::size_t events = events_until(cursor_->poses().time_s);
    told_events_ = events - std::min(events, kMostPastEvents);
  }
}

void FoxgloveSession::take(const FoxgloveUnsubscribe& unsubscribe) {
  for (const std::uint32_t id : unsubscribe.ids) {
    if (channels_.erase(id) == 0) refuse(fmt::format("there is no subscription {}", id));
  }
}

void FoxgloveSession::take(const FoxgloveRefused& refused) {
  refuse(fmt::format("read-only: `{}` is refused", refused.op));
}

std::optional<std::uint32_t> FoxgloveSession::subscription_of(Kind kind) const {
  for (const auto& [id, channel] : channels_) {
    if (topics_->topic_of(channel)->kind == kind) return id;
  }
  return std::nullopt;
}

bool FoxgloveSession::wants_poses() const { return !channels_.empty(); }

std::vector<LookedAt> FoxgloveSession::looked_at() const {
  std::vector<LookedAt> looked_at;
  for (const auto& [id, channel] : channels_) {
    const auto* const topic = topics_->topic_of(channel);
    if (topic->kind == Kind::kScan) looked_at.push_back(topic->sensor);
  }
  std::ranges::sort(looked_at);
  return looked_at;
}

void FoxgloveSession::tick(Clock::time_point now, FoxgloveFrames& frames) {
  // There is no acknowledgement in this protocol. What has not gone to the kernel, whose buffer is
  // small, is what a slow line is behind: it gets the newest state once it has room.
  if (!source_ || broken_ || socket_.waiting_bytes() > 0) return;
  if (now < next_frame_) return;
  const PlayState state = playhead_->look(now);
  const bool due = now - last_time_ >= kFoxgloveClock || state.kind != told_kind_;
  if (state.picture == picture_ && !changed_ && !due) {
    // What happens while the run is held.
    send_log(state.now_s);
    return;
  }
  // On a grid: the tick of the server does not divide the spacing.
  next_frame_ = std::max(next_frame_, now - kFoxgloveSpacing) + kFoxgloveSpacing;
  if (const auto gone = cursor_->go_to(state.now_s); !gone) {
    refuse(gone.error().text());
    broken_ = true;
    return;
  }
  change_bodies(cursor_->take_bodies());
  if (due) last_time_ = now;
  send_frame(state, frames);
  picture_ = state.picture;
  told_kind_ = state.kind;
  changed_ = false;
}

void FoxgloveSession::send_frame(const PlayState& state, FoxgloveFrames& frames) {
  socket_.send_binary(payload(foxglove_time(foxglove_ns(cursor_->poses().time_s))));
  send_shared(Kind::kTransforms, frames);
  send_shared(Kind::kPoses, frames);
  send_scans();
  send_robots();
  send_scene();
  send_log(state.now_s);
  send_data(Kind::kRun, state.now_s, FoxgloveTopics::run(state));
}

void FoxgloveSession::send_data(Kind kind, double time_s, std::string_view message) {
  const auto id = subscription_of(kind);
  if (id) socket_.send_binary(payload(foxglove_data(*id, foxglove_ns(time_s), message)));
}

void FoxgloveSession::send_shared(Kind kind, FoxgloveFrames& frames) {
  if (!subscription_of(kind)) return;
  const PosesAt& poses = cursor_->poses();
  const auto encoded = [&] {
    return kind == Kind::kPoses ? topics_->poses(poses) : topics_->transforms(poses);
  };
  if (poses.serial == 0) return send_data(kind, poses.time_s, encoded());
  // One encoding serves all clients of the same rights.
  std::string& shared = frames[{source_.get(), poses.serial, kind}];
  if (shared.empty()) shared = encoded();
  send_data(kind, poses.time_s, shared);
}

void FoxgloveSession::send_scans() {
  const std::vector<LookedAt> sensors = looked_at();
  if (sensors.empty()) return;
  std::map<LookedAt, std::uint32_t> ids;
  for (const auto& [id, channel] : channels_) {
    const auto* const topic = topics_->topic_of(channel);
    if (topic->kind == Kind::kScan) ids[topic->sensor] = id;
  }
  for (const ReadingAt& reading : cursor_->readings(sensors, false)) {
    const LookedAt looked{reading.slot, reading.sensor};
    const auto id = ids.find(looked);
    if (id == ids.end() || reading.part != 0) continue;
    const auto [told, is_new] = told_scans_.try_emplace(looked, reading.stamp_s);
    if (!is_new && told->second == reading.stamp_s) continue;
    told->second = reading.stamp_s;
    const std::string message = topics_->points(reading);
    if (message.empty()) continue;
    socket_.send_binary(payload(foxglove_data(id->second, foxglove_ns(reading.stamp_s), message)));
  }
}

void FoxgloveSession::send_robots() {
  if (!subscription_of(Kind::kRobots)) return;
  const PosesAt& poses = cursor_->poses();
  const auto& robots = topics_->robots();
  FoxgloveScene scene;
  scene.anew = robots_anew_;
  if (robots_anew_) told_robots_.assign(robots.size(), std::nullopt);
  robots_anew_ = false;
  for (std::size_t slot = 0; slot < std::min(robots.size(), poses.robots.size()); ++slot) {
    const std::uint16_t flags = poses.robots[slot].flags;
    std::optional<std::uint16_t> shown;
    if ((flags & kKnown) != 0) shown = static_cast<std::uint16_t>(flags & kShownFlags);
    // Clients keep entities and move them with the transforms; only colour and presence are sent.
    if (shown == told_robots_[slot]) continue;
    told_robots_[slot] = shown;
    if (shown) {
      scene.entities.push_back(robot_entity(robots[slot], flags, poses.time_s));
    } else {
      scene.gone.push_back(robots[slot].at("name").get<std::string>());
    }
  }
  if (!scene.anew && scene.gone.empty() && scene.entities.empty()) return;
  send_data(Kind::kRobots, poses.time_s, scene_update(std::move(scene), poses.time_s));
}

void FoxgloveSession::change_bodies(const std::string& change) {
  // No change is an empty text, which is no JSON.
  const auto json = nlohmann::ordered_json::parse(change, nullptr, false);
  if (!json.is_object()) return;
  for (const auto& body : json.at("set")) {
    const auto id = body.at("id").get<std::int64_t>();
    bodies_[id] = body;
    changed_bodies_.insert(id);
  }
  for (const auto& gone : json.at("gone")) {
    const auto id = gone.get<std::int64_t>();
    bodies_.erase(id);
    changed_bodies_.insert(id);
  }
}

void FoxgloveSession::send_scene() {
  if (const std::uint64_t revision = source_->bodies_revision(); revision != told_bodies_) {
    change_bodies(source_->bodies_changed_since(told_bodies_));
    told_bodies_ = revision;
  }
  if (!subscription_of(Kind::kScene)) return;
  const double time_s = cursor_->poses().time_s;
  FoxgloveScene scene;
  scene.anew = std::exchange(scene_anew_, false);
  if (scene.anew) {
    for (const auto& [id, body] : bodies_) scene.entities.push_back(body_entity(body, time_s));
  } else {
    for (const std::int64_t id : changed_bodies_) {
      const auto body = bodies_.find(id);
      if (body == bodies_.end()) {
        scene.gone.push_back(std::to_string(id));
      } else {
        scene.entities.push_back(body_entity(body->second, time_s));
      }
    }
  }
  changed_bodies_.clear();
  if (!scene.anew && scene.gone.empty() && scene.entities.empty()) return;
  send_data(Kind::kScene, time_s, scene_update(std::move(scene), time_s));
}

std::size_t FoxgloveSession::events_until(double time_s) const {
  const auto events = source_->events();
  if (source_->about().live) return events.size();
  // A recording knows what will happen; its clients shall not.
  const auto later = std::ranges::upper_bound(events, time_s, {}, &LogEvent::t_s);
  return static_cast<std::size_t>(later - events.begin());
}

void FoxgloveSession::send_log(double now_s) {
  if (!subscription_of(Kind::kLog)) return;
  const auto events = source_->events();
  const std::size_t until = events_until(now_s);
  // Repetitions are folded into what was told; they are not told again.
  for (; told_events_ < until; ++told_events_) {
    send_data(Kind::kLog, events[told_events_].t_s, FoxgloveTopics::log(events[told_events_]));
  }
}

}  // namespace rave::gui_server
