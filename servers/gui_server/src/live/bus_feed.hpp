// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "live/live_box.hpp"
#include "rave/onlook/listener.hpp"
#include "rave/watch/observer.hpp"
#include "rave/world/body.hpp"

namespace rave::gui_server {

/// Looks on at a run over its bus in a thread of its own, and hands what it sees to the server's
/// thread: pictures, readings that pages look at, and what happens.
class BusFeed {
 public:
  /// What the scenario says of the world.
  struct World {
    std::size_t robots = 0;
    std::map<std::uint32_t, world::Obstacle> obstacles;  ///< Of the start, by number.
  };
  /// Called once, in the thread of the feed, when the run is over and its processes have left, with
  /// where they left their recordings. Returns what pages then say; empty: what the run says.
  using OnOver = std::function<std::string(const std::vector<watch::KeptAt>& kept)>;
  /// `listener`: on the bus of the observer. `on_over` may be empty.
  BusFeed(std::unique_ptr<watch::Observer> observer, onlook::Listener listener,
          std::shared_ptr<LiveBox> box, World world, OnOver on_over);
  /// Once. Error kIo: the system grants no thread.
  [[nodiscard]] Status start();

 private:
  using Clock = std::chrono::steady_clock;

  void work(const std::stop_token& stop);
  void ask();
  void tell_news(const watch::RunView& view);
  void tell_obstacle(const onlook::HeardObstacle& heard, LiveNews& news);
  void tell_processes(const watch::RunView& view, LiveNews& news);
  void look_at_end(const watch::RunView& view);
  void draw(const watch::RunView& view);
  void draw_readings(LivePicture& picture) const;

  std::unique_ptr<watch::Observer> observer_;
  onlook::Listener listener_;
  std::shared_ptr<LiveBox> box_;
  World world_;
  std::uint32_t serial_ = 0;
  Clock::time_point next_hosts_{};
  std::string hosts_ = "[]";
  std::uint64_t hosts_revision_ = 0;
  std::map<std::string, bool> there_;  ///< By process: whether it was there.
  OnOver on_over_;                     ///< Empty after the end.
  std::string end_text_;
  std::jthread thread_;  ///< Last, so that it ends first.
};

}  // namespace rave::gui_server
