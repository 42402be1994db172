// SPDX-License-Identifier: Apache-2.0
#include "live/bus_feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "live/hosts_json.hpp"
#include "rave/base/thread.hpp"
#include "run/scene_json.hpp"

namespace rave::gui_server {
namespace {

/// Between two states: as fast as pages draw, or seldom while no page looks.
constexpr Duration kWatched = from_seconds(0.033);
constexpr Duration kUnwatched = from_seconds(0.25);
constexpr auto kHostsInterval = std::chrono::seconds(1);

PlayState standing_of(const watch::RunView& view) {
  using Kind = PlayState::Kind;
  // In the order of watch::Phase.
  constexpr Kind kKinds[] = {Kind::kWaiting, Kind::kWaiting, Kind::kRunning, Kind::kWaiting,
                             Kind::kPaused,  Kind::kEnded,   Kind::kEnded};
  PlayState state;
  state.kind = kKinds[static_cast<std::size_t>(view.phase)];
  state.reason = view.text;
  state.speed = view.speed.value_or(0);
  if (view.phase != watch::Phase::kUnknown) return state;
  // Hosts in real time may have no manager.
  const bool here = std::ranges::any_of(view.hosts, [](const watch::HostView& host) {
    return !host.manager && host.standing == watch::Standing::kHere;
  });
  if (here) state.kind = Kind::kRunning;
  if (!here && state.reason.empty()) state.reason = "No process of this run was found.";
  return state;
}

RobotState state_of(const watch::RobotView& robot) {
  RobotState state;
  state.speed_mps = robot.speed_mps.value_or(0);
  if (robot.report) {
    // What people see of a robot is what it reports, as in a run of one process.
    const watch::RobotReport& report = *robot.report;
    state.x_m = report.x_m;
    state.y_m = report.y_m;
    state.yaw_rad = report.yaw_rad;
    state.variance_xy_m2 = static_cast<float>(report.variance_xy_m2);
    state.variance_yaw_rad2 = static_cast<float>(report.variance_yaw_rad2);
    state.set(report.known, kKnown);
    // Stale by its own clock, or because its host is silent.
    state.set(report.stale || robot.stale, kStale);
    state.set(report.stopped, kStopped);
    state.set(!report.armed, kUnarmed);
    state.set(report.real, kReal);
    state.set(report.touches, kTouching);
    return state;
  }
  // Without a report, as before the first one: the pose that its host resolved, and flags that are
  // not known stay off.
  state.set(robot.x_m.has_value(), kKnown);
  state.x_m = robot.x_m.value_or(0);
  state.y_m = robot.y_m.value_or(0);
  state.yaw_rad = robot.yaw_rad.value_or(0);
  state.set(robot.stale, kStale);
  state.set(robot.simulated == false, kReal);
  return state;
}

/// What hosts resolve of a simulated robot is where it truly is; of a real one it is unknown.
RobotState truth_of(const watch::RobotView& robot) {
  const bool simulated = robot.report ? !robot.report->real : robot.simulated == true;
  if (!simulated || !robot.x_m || !robot.y_m || !robot.yaw_rad) return {};
  return {*robot.x_m, *robot.y_m, *robot.yaw_rad, 0, kKnown};
}

}  // namespace

BusFeed::BusFeed(std::unique_ptr<watch::Observer> observer, onlook::Listener listener,
                 std::shared_ptr<LiveBox> box, World world, OnOver on_over)
    : observer_(std::move(observer)),
      listener_(std::move(listener)),
      box_(std::move(box)),
      world_(std::move(world)),
      on_over_(std::move(on_over)) {}

Status BusFeed::start() {
  return start_thread(thread_, "the page's feed",
                      [this](const std::stop_token& stop) { work(stop); });
}

void BusFeed::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    ask();
    observer_->watch(box_->max_hz.load(std::memory_order_relaxed) > 0 ? kWatched : kUnwatched,
                     stop);
    listener_.hear();
    const watch::RunView view = observer_->view(true);
    tell_news(view);
    look_at_end(view);
    draw(view);
  }
}

/// What pages look at, all together.
void BusFeed::ask() {
  static_cast<void>(box_->wants.take());
  const Audience& wants = box_->wants.value();
  onlook::Asked asked;
  asked.robots = box_->max_hz.load(std::memory_order_relaxed) > 0;
  asked.parts = wants.parts;
  asked.sensors = wants.looked_at;
  asked.maps = wants.maps;
  asked.probes = wants.probes;
  listener_.look(asked);
}

void BusFeed::tell_news(const watch::RunView& view) {
  auto news = std::make_unique<LiveNews>();
  for (onlook::HeardEvent& event : listener_.take_events()) {
    const int slot = event.robot.valid() ? static_cast<int>(event.robot.value()) : -1;
    news->events.push_back(
        {event.t_s, slot, std::string(to_string(event.kind)), std::move(event.text)});
  }
  for (const onlook::HeardObstacle& heard : listener_.take_obstacles()) {
    tell_obstacle(heard, *news);
  }
  tell_processes(view, *news);
  news->tiles = listener_.take_tiles();
  if (news->events.empty() && news->set.empty() && news->gone.empty() && news->tiles.empty()) {
    return;
  }
  box_->news.push(std::move(news));
}

void BusFeed::tell_obstacle(const onlook::HeardObstacle& heard, LiveNews& news) {
  if (heard.removed) {
    news.gone.push_back(heard.id);
    return;
  }
  using Kind = sim::ObstacleChange::Kind;
  world::Obstacle obstacle;
  if (heard.stands.kind == Kind::kMove) {
    // A move has the pose alone; shape and name are those of the scenario.
    const auto start = world_.obstacles.find(heard.id);
    if (start == world_.obstacles.end()) return;
    obstacle = start->second;
  } else {
    obstacle.body = heard.stands.body;
    obstacle.body.name = heard.stands.name;
  }
  obstacle.X_WB = heard.stands.X_WB;
  news.set.emplace_back(heard.id, body_json(heard.id, obstacle));
}

/// A process that is lost, or back, is news.
void BusFeed::tell_processes(const watch::RunView& view, LiveNews& news) {
  if (view.phase == watch::Phase::kEnded || view.phase == watch::Phase::kFailed) return;
  for (const watch::HostView& host : view.hosts) {
    const std::string name =
        host.manager ? "the environment manager" : fmt::format("host `{}`", host.name);
    const bool here =
        host.standing == watch::Standing::kHere || host.standing == watch::Standing::kLate;
    // A process that is seen for the first time is no news, and one that waits has not begun.
    const auto [known, fresh] = there_.try_emplace(name, here);
    if (fresh || known->second == here || host.standing == watch::Standing::kWaiting) continue;
    known->second = here;
    news.events.push_back(
        {view.time_s.value_or(0), -1, here ? "process back" : "process lost", name});
  }
}

/// Recordings are complete when their processes have left; that of the manager is before it tells
/// the end.
void BusFeed::look_at_end(const watch::RunView& view) {
  const bool over = view.phase == watch::Phase::kEnded || view.phase == watch::Phase::kFailed;
  const auto left = [](const watch::HostView& host) {
    return host.manager || host.standing == watch::Standing::kGone ||
           host.standing == watch::Standing::kDropped;
  };
  if (!over || !on_over_ || !std::ranges::all_of(view.hosts, left)) return;
  const std::string text = std::exchange(on_over_, nullptr)(observer_->kept());
  end_text_ = view.text.empty() || text.empty() ? text : fmt::format("{}. {}", view.text, text);
}

void BusFeed::draw(const watch::RunView& view) {
  LivePicture& picture = box_->pictures.draft();
  // A serial of 0 would mean a moment of one page alone.
  if (++serial_ == 0) ++serial_;
  picture.poses.serial = serial_;
  picture.poses.time_s = view.time_s.value_or(0);
  picture.poses.step = view.step.value_or(0);
  picture.poses.taken_us = taken_now_us();
  picture.poses.robots.assign(world_.robots, RobotState{});
  const bool truth = box_->wants.value().truth;
  picture.poses.truth.assign(truth ? world_.robots : 0, RobotState{});
  std::set<std::string_view> gone;
  for (const watch::HostView& host : view.hosts) {
    if (!host.manager && host.standing == watch::Standing::kGone) gone.insert(host.name);
  }
  for (const watch::RobotView& robot : view.robots) {
    // Numbers come from other processes.
    if (robot.number >= world_.robots) continue;
    RobotState& state = picture.poses.robots[robot.number];
    state = state_of(robot);
    if (truth) picture.poses.truth[robot.number] = truth_of(robot);
    // A lost process publishes nothing more.
    if (gone.contains(robot.host)) state.set(true, kStale);
  }
  draw_readings(picture);
  picture.standing = standing_of(view);
  if (!end_text_.empty()) picture.standing->reason = end_text_;
  if (const auto now = Clock::now(); now >= next_hosts_) {
    next_hosts_ = now + kHostsInterval;
    // Once a second, because people read the table: faster changes only flicker.
    hosts_ = hosts_json(view);
    ++hosts_revision_;
  }
  picture.hosts = hosts_;
  picture.hosts_revision = hosts_revision_;
  box_->publish();
}

void BusFeed::draw_readings(LivePicture& picture) const {
  picture.reading_count = 0;
  for (const auto& [key, heard] : listener_.readings()) {
    if (picture.reading_count == picture.readings.size()) picture.readings.emplace_back();
    picture.readings[picture.reading_count++] = heard;
  }
}

}  // namespace rave::gui_server
