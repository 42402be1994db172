// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/onlook/asked.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/obstacle_change.hpp"

namespace rave::onlook {

/// A reading as rows of numbers, one row after the other.
struct HeardReading {
  LookedAt sensor;
  std::uint8_t part = 0;  ///< 0 what the program got, 1 the real half, 2 the virtual half.
  double stamp_s = 0;
  std::uint32_t rows = 0;
  std::uint32_t fields = 0;
  std::vector<float> values;
};

struct HeardEvent {
  double t_s = 0;
  RobotId robot;  ///< None: it concerns the world.
  sim::EventKind kind = sim::EventKind::kContact;
  std::string text;  ///< Without control characters.
};

/// How an obstacle stands that is not as at the start.
struct HeardObstacle {
  std::uint32_t id = 0;
  bool removed = false;
  /// An addition at its present place, or of one of the start where it was moved to.
  sim::ObstacleChange stands;
};

/// The end of somebody who looks on: says what it looks at, and hears what hosts tell. No host
/// waits for it. Must be gone before its bus; thread: that of the bus.
class Listener {
 public:
  using Clock = std::chrono::steady_clock;

  /// Errors: those of bus::Writer::create() and bus::Reader::create().
  [[nodiscard]] static Result<Listener> create(bus::Bus& bus);

  /// What it looks at from now on; to be called often, since hosts forget it. Of more sensors than
  /// rave_wire_kMaxLookedAt the first ones count.
  void look(const Asked& asked);
  /// Takes in what has come.
  void hear();

  /// The newest of each sensor and part that was looked at and is not too old.
  [[nodiscard]] const std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>,
                               HeardReading>&
  readings() const noexcept {
    return readings_;
  }
  /// What happened, in order of time, since the last call; what concerns the world once, however
  /// many hosts tell it.
  [[nodiscard]] std::vector<HeardEvent> take_events();
  /// Obstacles that changed since the last call, each as it stands now.
  [[nodiscard]] std::vector<HeardObstacle> take_obstacles();
  /// Tiles of maps that came since the last call, also of global maps, for which nobody asks.
  [[nodiscard]] std::vector<maps::MapTile> take_tiles() { return std::exchange(tiles_, {}); }
  /// A run begins anew in which obstacles are as at the start.
  void forget();

 private:
  struct Told {
    double t_s = 0;
    std::uint64_t writer = 0;
  };
  Listener(bus::Writer<bus::Look> looks, bus::Reader<bus::Readings> readings,
           bus::Reader<bus::RunEvents> events, bus::Reader<bus::LastObstacle> obstacles,
           bus::Reader<bus::MapTile> tiles)
      : looks_(std::move(looks)),
        readings_in_(std::move(readings)),
        events_in_(std::move(events)),
        obstacles_in_(std::move(obstacles)),
        tiles_in_(std::move(tiles)) {}

  [[nodiscard]] bool is_asked(const LookedAt& sensor) const;
  void hear(const bus::Readings& sample);
  void hear(const bus::RunEvents& sample);
  void hear(const bus::LastObstacle& sample);
  [[nodiscard]] bool is_told(const rave_wire_RunEvent& event, double t_s, std::uint64_t writer);

  bus::Writer<bus::Look> looks_;
  bus::Reader<bus::Readings> readings_in_;
  bus::Reader<bus::RunEvents> events_in_;
  bus::Reader<bus::LastObstacle> obstacles_in_;
  bus::Reader<bus::MapTile> tiles_in_;
  Asked asked_;
  std::uint64_t number_ = 0;
  Clock::time_point next_look_{};
  std::vector<rave_wire_LookedAt> sensors_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, HeardReading> readings_;
  std::vector<HeardEvent> events_;
  std::map<std::string, Told> told_;                  ///< Of the world, by what was said.
  std::map<std::uint32_t, std::uint64_t> revisions_;  ///< By obstacle.
  std::vector<HeardObstacle> obstacles_;
  std::vector<maps::MapTile> tiles_;
};

}  // namespace rave::onlook
