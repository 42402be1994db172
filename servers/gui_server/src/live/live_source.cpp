// SPDX-License-Identifier: Apache-2.0
#include "live/live_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "live/parameters_json.hpp"
#include "rights/scenario_rights.hpp"
#include "run/components.hpp"
#include "run/scene_json.hpp"

namespace rave::gui_server {
namespace {

/// Poses that are kept for trails, of all robots and moments together: some 100 MB.
constexpr std::size_t kMostPast = 2'000'000;
/// Over so long the speed of a run is measured.
constexpr auto kMeasure = std::chrono::milliseconds(500);
constexpr double kFastestRun = 1000;
constexpr double kSlowestRun = 1.0 / 64;

/// Bodies as an array of JSON.
std::string joined(const std::vector<std::pair<std::uint32_t, std::string>>& bodies) {
  std::string json(1, '[');
  for (const auto& [id, body] : bodies) {
    if (json.size() > 1) json += ',';
    json += body;
  }
  return json + ']';
}

const char* const kSeekLater = "The timeline is available when the run has ended.";

class LiveCursor final : public Cursor {
 public:
  explicit LiveCursor(const LiveSource& source) : source_(source) {}

  /// Moments before the present one are those that trails are made of.
  Status go_to(double time_s) override {
    past_ = nullptr;
    const auto& past = source_.past();
    if (time_s >= source_.poses().time_s) return {};
    const auto later = std::find_if(past.begin(), past.end(), [=](const PosesAt& poses) {
      // Times of a run are multiples of the step, added up in doubles: two that are meant to be
      // equal may differ in the last bits.
      return poses.time_s > time_s + 1e-9;
    });
    // A time before the first one that is kept shows the present; the caller notices by the time.
    if (later != past.begin()) past_ = &*std::prev(later);
    return {};
  }
  [[nodiscard]] const PosesAt& poses() const noexcept override {
    return past_ != nullptr ? *past_ : source_.poses();
  }
  [[nodiscard]] std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                bool parts) override {
    std::vector<ReadingAt> readings;
    const LivePicture& picture = source_.picture();
    for (std::size_t i = 0; i < picture.reading_count; ++i) {
      const ReadingAt& reading = picture.readings[i];
      const LookedAt looked{reading.slot, reading.sensor};
      if (reading.part != 0 && !parts) continue;
      if (std::find(sensors.begin(), sensors.end(), looked) == sensors.end()) continue;
      readings.push_back(reading);
    }
    return readings;
  }

 private:
  const LiveSource& source_;
  const PosesAt* past_ = nullptr;
};

/// All pages are at the present of the run.
class LivePlayhead final : public Playhead {
 public:
  explicit LivePlayhead(LiveSource& source) : source_(source) {}

  std::string take(const TransportMessage& transport, Clock::time_point /*now*/) override {
    return source_.take(transport);
  }
  PlayState look(Clock::time_point /*now*/) override {
    PlayState state = source_.state();
    // The first look of a page jumps, so that the page gets the past for its trails.
    state.jumped = std::exchange(new_, false);
    return state;
  }

 private:
  LiveSource& source_;
  bool new_ = true;
};

}  // namespace

Result<LiveSource::Start> LiveSource::Start::of(const config::ExpandedScenario& scenario,
                                                const record::RunInfo& run,
                                                const record::StringMap& hybrids,
                                                const sim::EngineSpec& spec) {
  Start start;
  start.about.live = true;
  start.about.name = scenario.scenario.name.value;
  start.about.step_s = run.step_s;
  start.about.seed = run.seed;
  start.about.duration_s = scenario.scenario.duration_s.known_s();
  start.about.rights = rights_of(scenario.scenario.gui);
  RAVE_TRY_ASSIGN(start.about.components, components_of(scenario.scenario.gui));
  start.robots_json = with_parameters(robots_of(scenario, run, hybrids), spec);
  for (const record::RecordedRobot& robot : run.robots) start.robots.push_back(robot.name);
  for (std::size_t o = 0; o < spec.world.obstacle_count(); ++o) {
    const std::uint32_t id = spec.world.obstacle_id(o);
    const world::Obstacle& obstacle = *spec.world.obstacle(id);
    if (!obstacle.removed) start.bodies.emplace_back(id, body_json(id, obstacle));
  }
  return start;
}

LiveSource::LiveSource(Start start, std::shared_ptr<LiveBox> box, std::unique_ptr<RunPort> port)
    : start_(std::move(start)),
      box_(std::move(box)),
      port_(std::move(port)),
      fold_(start_.robots),
      set_values_(start_.robots_json),
      component_watch_(start_.scenario),
      maps_(start_.robots_json, joined(start_.bodies)) {
  write_bodies();
  // A frame has all robots of the roster, also before the first state has come.
  poses_.robots.resize(start_.robots.size());
  state_.duration_s = start_.about.duration_s;
  for (std::uint32_t slot = 0; slot < start_.robots.size(); ++slot) {
    slots_.emplace(start_.robots[slot], slot);
    leases_.push_back({slot, "", {}, ""});
  }
  leases_changed_.assign(start_.robots.size(), leases_revision_);
}

Powers LiveSource::powers() const {
  Powers powers{{"stop", "release", "readings", "hybrid_parts", "obstacles", "log", "command",
                 "edit", "chat", "maps", "true_pose"},
                {{"seek", kSeekLater},
                 {"recording", "The recording can be downloaded when the run has ended."}}};
  if (start_.probes) powers.may.emplace_back("probe");
  for (const char* const word : {"play", "pace", "step"}) {
    if (const std::string why_not = port_->why_not_held(); !why_not.empty()) {
      powers.why_not[word] = why_not;
    } else {
      powers.may.emplace_back(word);
    }
  }
  return powers;
}

Status LiveSource::refresh_components() {
  auto read = component_watch_.look();
  if (!read) return {};
  if (!*read) {
    fold_.add(state_.now_s, -1, "panels not changed", read->error().text());
    return tl::unexpected(read->error());
  }
  start_.about.components = **std::move(read);
  return {};
}

Result<ProbeMade> LiveSource::probe(const ProbeRequest& request) {
  if (!start_.probes) return fail(ErrorCode::kState, "No virtual sensors can be tried here.");
  if (request.slot >= start_.robots.size()) {
    return fail(ErrorCode::kNotFound, "There is no such robot.");
  }
  return start_.probes->make(request, request.slot);
}

std::unique_ptr<Cursor> LiveSource::open_cursor() { return std::make_unique<LiveCursor>(*this); }

std::unique_ptr<Playhead> LiveSource::open_playhead() {
  return std::make_unique<LivePlayhead>(*this);
}

void LiveSource::tick(Playhead::Clock::time_point now, const Audience& audience) {
  // Nothing else is published with it, so it needs no order.
  box_->max_hz.store(audience.max_hz, std::memory_order_relaxed);
  // Only what differs is published: the host's thread copies the wants each time.
  if (audience != wants_) {
    wants_ = audience;
    box_->wants.draft() = wants_;
    box_->wants.publish();
  }
  take_news();
  learn_status(now);
  take_picture(now);
  answer_asked();
  const std::lock_guard lock(mutex_);
  if (ended_) {
    state_.kind = PlayState::Kind::kEnded;
    state_.reason = end_reason_;
    state_.speed = 0;
  } else if (const auto& standing = picture().standing) {
    // A pause that was asked for is shown at once, before the run says that it stands.
    const bool held = paused() && standing->kind != PlayState::Kind::kEnded;
    state_.kind = held ? PlayState::Kind::kPaused : standing->kind;
    // With a reason once the run itself says so.
    state_.reason = held && standing->kind == PlayState::Kind::kRunning ? "" : standing->reason;
    state_.speed = standing->speed;
  } else {
    state_.kind = paused() ? PlayState::Kind::kPaused : PlayState::Kind::kRunning;
  }
}

bool LiveSource::paused() const { return port_->held().paused; }

void LiveSource::take_news() {
  for (const auto& news : box_->news.take()) {
    for (const LiveEvent& event : news->events) {
      fold_.add(event.t_s, event.slot, event.kind, event.text);
    }
    for (const auto& [id, json] : news->set) {
      body_changes_.push_back({++bodies_revision_, id, json});
    }
    for (const std::uint32_t id : news->gone) {
      body_changes_.push_back({++bodies_revision_, id, ""});
    }
    if (!news->set.empty() || !news->gone.empty()) write_bodies();
    for (const maps::MapTile& tile : news->tiles) maps_.add(tile);
  }
}

/// A run that is held draws on, because pages may look elsewhere meanwhile. What they would be
/// shown is the same then, but for its serial and the wall time.
bool LiveSource::shows_other(const LivePicture& next) {
  next_readings_.clear();
  for (std::size_t i = 0; i < next.reading_count; ++i) {
    const ReadingAt& reading = next.readings[i];
    next_readings_.emplace_back(reading.slot, reading.sensor, reading.part, reading.stamp_s);
  }
  const PosesAt& poses = next.poses;
  const bool other = poses.time_s != poses_.time_s || poses.step != poses_.step ||
                     poses.robots != poses_.robots || poses.truth != poses_.truth ||
                     next_readings_ != shown_readings_;
  std::swap(next_readings_, shown_readings_);
  return other;
}

void LiveSource::take_picture(Playhead::Clock::time_point now) {
  if (box_->pictures.take()) {
    const bool other = shows_other(picture());
    poses_ = picture().poses;
    const PosesAt& poses = poses_;
    state_.now_s = state_.end_s = poses.time_s;
    // A run in progress can show its present only; the page draws its timeline from these two.
    state_.begin_s = poses.time_s;
    if (other || state_.picture == 0) state_.picture = poses.serial;
    if (past_.empty() || poses.time_s >= past_.back().time_s + kPastSpacing_s) {
      past_.push_back(poses);
      // Trails are of reported poses; the true ones would double the memory.
      past_.back().truth = {};
    }
    // Two bounds: in time for small runs, and in memory for runs with thousands of robots.
    const std::size_t most = kMostPast / std::max<std::size_t>(1, poses.robots.size());
    while (!past_.empty() &&
           (past_.front().time_s < poses.time_s - kPast_s || past_.size() > most)) {
      past_.pop_front();
    }
  }
  if (now - measured_at_ < kMeasure) return;
  const double passed_s = std::chrono::duration<double>(now - measured_at_).count();
  const bool measured = measured_at_ != Playhead::Clock::time_point();
  if (measured) state_.speed = std::max(0.0, (state_.now_s - measured_s_) / passed_s);
  measured_at_ = now;
  measured_s_ = state_.now_s;
  state_.pace = port_->held().pace.value_or(state_.pace);
  if (const auto status = port_->own_status()) {
    own_host_.look(now, start_.about.name, poses_.step, *status);
  }
}

void LiveSource::write_bodies() {
  for (const BodyChange& change : body_changes_) {
    auto& bodies = start_.bodies;
    const auto known = std::find_if(bodies.begin(), bodies.end(),
                                    [&](const auto& body) { return body.first == change.id; });
    // Changes that were applied before come again here. Each sets a whole body, so that does no
    // harm.
    if (change.json.empty()) {
      if (known != bodies.end()) bodies.erase(known);
    } else if (known != bodies.end()) {
      known->second = change.json;
    } else {
      bodies.emplace_back(change.id, change.json);
    }
  }
  bodies_json_ = joined(start_.bodies);
  // Pages that are there get the last ones; older changes are in the scene of who comes.
  constexpr std::size_t kKept = 1000;
  if (body_changes_.size() > kKept) {
    body_changes_.erase(body_changes_.begin(), body_changes_.end() - kKept);
  }
}

std::string LiveSource::bodies_changed_since(std::uint64_t revision) const {
  std::map<std::uint32_t, const std::string*> changed;
  for (const BodyChange& change : body_changes_) {
    // Later changes come later in the list and replace earlier ones: a body that moved ten times
    // since is sent once.
    if (change.revision > revision) changed[change.id] = &change.json;
  }
  std::string set;
  std::string gone;
  for (const auto& [id, json] : changed) {
    std::string& list = json->empty() ? gone : set;
    if (!list.empty()) list += ',';
    list += json->empty() ? std::to_string(id) : *json;
  }
  return fmt::format(R"({{"type":"scene_change","set":[{}],"gone":[{}]}})", set, gone);
}

std::string LiveSource::take(const TransportMessage& transport) {
  using Do = TransportMessage::Do;
  if (transport.what == Do::kSeek) return kSeekLater;
  if (std::string why_not = port_->why_not_held(); !why_not.empty()) return why_not;
  if (state_.kind == PlayState::Kind::kEnded) return "The run has ended.";
  TransportMessage asked = transport;
  if (asked.what == Do::kStep) {
    // The bar of the page steps back as well, which only a replay can do.
    if (asked.value < 1) return "A run cannot go back in time.";
    asked.value = std::min(std::round(asked.value), 1e6);
  } else if (asked.what == Do::kPace) {
    asked.value = asked.value <= 0 ? 0 : std::clamp(asked.value, kSlowestRun, kFastestRun);
  }
  port_->hold(asked);
  state_.pace = port_->held().pace.value_or(state_.pace);
  state_.kind = paused() ? PlayState::Kind::kPaused : PlayState::Kind::kRunning;
  return {};
}

void LiveSource::end(std::string reason) {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  end_reason_ = std::move(reason);
}

}  // namespace rave::gui_server
