// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
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

struct HeardEvent {
  double t_s = 0;
  RobotId robot;  ///< None: the event concerns the world.
  sim::EventKind kind = sim::EventKind::kContact;
  std::string text;  ///< Without control characters.
};

/// The state of an obstacle that differs from its initial one.
struct HeardObstacle {
  std::uint32_t id = 0;
  bool removed = false;
  /// An addition at the present pose, or a move if it is an initial obstacle.
  sim::ObstacleChange stands;
};

/// The monitor's side of observation: requests data and receives it from hosts, which never wait
/// for it. Destroy it before its bus; thread: that of the bus.
class Listener {
 public:
  using Clock = std::chrono::steady_clock;

  /// Errors: those of bus::Writer::create() and bus::Reader::create().
  [[nodiscard]] static Result<Listener> create(bus::Bus& bus);

  /// Sets the requested data. Call it often, because requests expire at the hosts. At most
  /// rave_wire_kMaxLookedAt sensors; further ones are ignored.
  void look(const Asked& asked);
  /// Receives the samples that have arrived.
  void hear();

  /// The newest reading of each requested sensor and part, unless too old.
  [[nodiscard]] const std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, ReadingAt>&
  readings() const noexcept {
    return readings_;
  }
  /// Events since the last call, in order of time. Events of the world appear once, even if several
  /// hosts report them.
  [[nodiscard]] std::vector<HeardEvent> take_events();
  /// Obstacles that changed since the last call, with their present states.
  [[nodiscard]] std::vector<HeardObstacle> take_obstacles();
  /// Map tiles received since the last call, including those of global maps, which need no request.
  [[nodiscard]] std::vector<maps::MapTile> take_tiles() { return std::exchange(tiles_, {}); }

 private:
  struct Told {
    double t_s = 0;
    std::uint64_t writer = 0;
  };
  Listener() = default;

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
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, ReadingAt> readings_;
  std::vector<HeardEvent> events_;
  std::map<std::string, Told> told_;                  ///< Events of the world, by their text.
  std::map<std::uint32_t, std::uint64_t> revisions_;  ///< By obstacle.
  std::vector<HeardObstacle> obstacles_;
  std::vector<maps::MapTile> tiles_;
};

}  // namespace rave::onlook
