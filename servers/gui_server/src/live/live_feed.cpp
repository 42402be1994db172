// SPDX-License-Identifier: Apache-2.0
#include "live/live_feed.hpp"

#include <algorithm>
#include <cmath>

#include "rave/onlook/command_row.hpp"
#include "rave/onlook/reading_rows.hpp"
#include "rave/onlook/sensor_parts.hpp"
#include "run/scene_json.hpp"

namespace rave::gui_server {
namespace {

/// A new page sees the present at once, even if the run is held then.
constexpr LiveFeed::Clock::duration kUnwatchedInterval = std::chrono::milliseconds(250);
/// The factor by which pictures become rarer while steps come late: pages get thinner before
/// anything else does.
constexpr int kLateFactor = 10;
/// A crowd may touch thousands of times in a step, which is unreadable.
constexpr std::size_t kMostEvents = 100;

LiveFeed::Clock::duration interval_of(double max_hz) {
  if (max_hz <= 0) return kUnwatchedInterval;
  const std::chrono::duration<double> asked(1 / max_hz);
  // Pages that look at no poses may need the readings of a picture.
  return std::min(std::chrono::duration_cast<LiveFeed::Clock::duration>(asked), kUnwatchedInterval);
}

void put_reading(LivePicture& picture, const LookedAt& looked, std::uint8_t part, ReadingKind kind,
                 const SampleHeader* header, const void* records) {
  // Sequence 0: the sensor has given no sample yet.
  if (header == nullptr || header->sequence == 0) return;
  if (picture.reading_count == picture.readings.size()) picture.readings.emplace_back();
  ReadingAt& reading = picture.readings[picture.reading_count++];
  reading.slot = looked.slot;
  reading.sensor = looked.sensor;
  reading.part = part;
  reading.stamp_s = SimTime{header->stamp_ns}.seconds();
  reading.values.clear();
  reading.fields = onlook::field_count(kind);
  reading.rows = onlook::add_rows(
      kind, header->count,
      {static_cast<const std::byte*>(records), header->count * record_size(kind)}, reading.values);
}

void put_commands(LivePicture& picture, const sim::Engine& engine, const LookedAt& looked) {
  const auto row = onlook::command_row(engine, RobotId(looked.slot));
  if (!row) return;
  if (picture.reading_count == picture.readings.size()) picture.readings.emplace_back();
  ReadingAt& reading = picture.readings[picture.reading_count++];
  reading = {looked.slot, looked.sensor, 0, engine.time().seconds(), 1, onlook::kCommandFields, {}};
  reading.values.assign(row->begin(), row->end());
}

}  // namespace

Status LiveFeed::run_begins(const runtime::RunView& run) {
  kinds_ = &run.kinds;
  touching_until_s_.assign(run.engine.spec().robots.size(), -1);
  global_maps_.emplace(maps::mapping_teams(run.engine.spec()));
  return begun_(run);
}

void LiveFeed::after_step(const runtime::StepView& step) {
  take_news(step);
  if (!maps_.empty()) maps_.after_step(step.engine);
  const auto now = Clock::now();
  const int slower = step.late ? kLateFactor : 1;
  const auto interval = slower * interval_of(box_->max_hz.load(std::memory_order_relaxed));
  const auto since = now - drawn_;
  if (since < interval) return;
  // Steps seldom end when a picture is due: what one comes late, the next comes earlier.
  drawn_ = since < 2 * interval ? drawn_ + interval : now;
  draw(step.engine, slower);
}

void LiveFeed::held(const sim::Engine& engine) {
  // The last step before a hold may have been left out, and a page may look elsewhere now.
  drawn_ = Clock::now();
  draw(engine, 1);
}

void LiveFeed::take_news(const runtime::StepView& step) {
  const sim::Engine& engine = step.engine;
  if (engine.events().empty() && step.beside.empty()) return;
  auto news = std::make_unique<LiveNews>();
  std::size_t left_out = 0;
  const auto take = [&](const sim::Event& event) {
    if (event.kind == sim::EventKind::kContact && event.robot.valid()) {
      touching_until_s_[event.robot.value()] = engine.time().seconds() + kTouch_s;
    }
    if (is_of_obstacle(event.kind) && event.other.valid()) {
      const std::uint32_t id = event.other.value();
      const world::Obstacle* const obstacle = engine.spec().world.obstacle(id);
      if (obstacle == nullptr || obstacle->removed) {
        news->gone.push_back(id);
      } else {
        news->set.emplace_back(id, body_json(id, *obstacle));
      }
    }
    if (news->events.size() >= kMostEvents && event.kind == sim::EventKind::kContact) {
      ++left_out;
      return;
    }
    news->events.push_back({engine.time().seconds(),
                            event.robot.valid() ? static_cast<int>(event.robot.value()) : -1,
                            std::string(to_string(event.kind)), runtime::words_of(*kinds_, event)});
  };
  for (const sim::Event& event : engine.events()) take(event);
  for (const sim::Event& event : step.beside) take(event);
  if (left_out > 0) {
    news->events.push_back(
        {engine.time().seconds(), -1, "contact", fmt::format("{} more in this step", left_out)});
  }
  box_->news.push(std::move(news));
}

void LiveFeed::draw_maps(const sim::Engine& engine, int slower) {
  const auto& teams = global_maps_->teams();
  mapping_ = box_->wants.value().maps;
  for (std::uint32_t r = 0; r < teams.size(); ++r) {
    if (!teams[r].empty() && !std::ranges::binary_search(box_->wants.value().maps, r)) {
      mapping_.push_back(r);
    }
  }
  maps_.ask(engine, mapping_);
  auto tiles = maps_.changed(engine, Clock::now(), slower);
  if (tiles.empty()) return;
  for (const maps::MapTile& tile : tiles) {
    // A map that does not fit the others of its team can be seen, but is no part of the global one.
    static_cast<void>(global_maps_->add(tile));
  }
  for (maps::MapTile& tile : global_maps_->changed()) tiles.push_back(std::move(tile));
  auto news = std::make_unique<LiveNews>();
  news->tiles = std::move(tiles);
  box_->news.push(std::move(news));
}

void LiveFeed::draw(const sim::Engine& engine, int slower) {
  static_cast<void>(box_->wants.take());
  LivePicture& picture = box_->pictures.draft();
  draw_poses(engine, picture.poses);
  draw_truth(engine, box_->wants.value().truth, picture.poses);
  // 0 says that a picture is of one page alone.
  if (++serial_ == 0) ++serial_;
  picture.poses.serial = serial_;
  draw_readings(engine, box_->wants.value(), picture);
  draw_probes(engine, picture);
  draw_maps(engine, slower);
  box_->publish();
}

void LiveFeed::draw_poses(const sim::Engine& engine, PosesAt& poses) const {
  const sim::EngineSpec& spec = engine.spec();
  poses.time_s = engine.time().seconds();
  // The number of the step that was computed last, not the count of steps.
  poses.step = engine.steps_done() == 0 ? 0 : engine.steps_done() - 1;
  poses.taken_us = taken_now_us();
  poses.robots.resize(spec.robots.size());
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::ReportedPose& reported = engine.reported(RobotId(r));
    RobotState& robot = poses.robots[r];
    robot = {reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad, 0, 0};
    robot.variance_xy_m2 = static_cast<float>(reported.pose.variance_xy_m2);
    robot.variance_yaw_rad2 = static_cast<float>(reported.pose.variance_yaw_rad2);
    const Twist2 v_W = engine.snapshot().velocity_W(RobotId(r));
    const double ahead = v_W.vx * std::cos(robot.yaw_rad) + v_W.vy * std::sin(robot.yaw_rad);
    // Negative when the robot drives backwards: the sign is that of the component along its
    // heading.
    robot.speed_mps = std::copysign(std::hypot(v_W.vx, v_W.vy), ahead);
    robot.set(reported.known, kKnown);
    robot.set(reported.stale, kStale);
    robot.set(engine.stopped(RobotId(r)), kStopped);
    robot.set(!engine.armed(RobotId(r)), kUnarmed);
    robot.set(!spec.types[spec.robots[r].type].simulated, kReal);
    robot.set(touching_until_s_[r] >= poses.time_s, kTouching);
  }
}

/// The true pose of a real robot is unknown.
void LiveFeed::draw_truth(const sim::Engine& engine, bool wanted, PosesAt& poses) {
  poses.truth.clear();
  if (!wanted) return;
  const sim::EngineSpec& spec = engine.spec();
  poses.truth.resize(spec.robots.size());
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!spec.types[spec.robots[r].type].simulated) continue;
    const Pose2 X_WR = engine.snapshot().pose(RobotId(r));
    poses.truth[r] = {X_WR.x, X_WR.y, X_WR.yaw, 0, kKnown};
  }
}

void LiveFeed::draw_readings(const sim::Engine& engine, const Audience& wants,
                             LivePicture& picture) {
  picture.reading_count = 0;
  for (const LookedAt& looked : wants.looked_at) {
    if (looked.sensor == onlook::kCommandsOf) {
      put_commands(picture, engine, looked);
      continue;
    }
    onlook::for_each_part(
        engine, RobotId(looked.slot), looked.sensor, wants.parts,
        [&](std::uint8_t part, ReadingKind kind, const SampleHeader* header, const void* records) {
          put_reading(picture, looked, part, kind, header, records);
        });
  }
}

void LiveFeed::draw_probes(const sim::Engine& engine, LivePicture& picture) {
  probes_.ask(engine, catalogue_, box_->wants.value().probes);
  if (probes_.empty()) return;
  probes_.sample(engine);
  for (const auto& [key, sensor] : probes_.all()) {
    if (!sensor) continue;
    put_reading(picture, {key.first, key.second}, 0, sensor->info().kind, &sensor->header(),
                sensor->records());
  }
}

}  // namespace rave::gui_server
