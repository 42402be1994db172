// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/maps/local_maps.hpp"
#include "rave/onlook/asked.hpp"
#include "rave/onlook/obstacle_teller.hpp"
#include "rave/onlook/reading_teller.hpp"
#include "rave/probe/probes.hpp"
#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// A host's end of what those who look on get: it hears what they look at, and tells readings,
/// events, obstacles and local maps. What robots and programs do does not depend on it, and it
/// waits for nobody. While nobody looks it tells of rare events and of obstacles, for those who
/// come later. Must be gone before its bus; thread: that of the bus.
class Teller {
 public:
  using Clock = std::chrono::steady_clock;

  /// More contacts of one step are counted and not told.
  static constexpr std::size_t kMostContacts = 100;

  struct Options {
    std::uint32_t host = 0;  ///< Its number in the scenario.
    bool obstacles = true;   ///< Nobody else on this bus tells of them for this host.
    /// An event for people, behind its kind. Null: its text.
    std::function<std::string(const sim::Event&)> words = {};
    /// Where the drivers of probes are found; outlives the teller. Null: there are no probes.
    plugin::Catalogue* catalogue = nullptr;
  };
  /// Errors: those of bus::Writer::create() and bus::Reader::create().
  [[nodiscard]] static Result<Teller> create(bus::Bus& bus, Options options);

  /// The engine is there, its first step is not done.
  void begin(const sim::EngineSpec& spec) {
    if (obstacles_) obstacles_->begin(spec);
  }
  /// A step is done, in which `events` happened, and `beside` the engine others. `late`: steps come
  /// late, so less is told.
  void after_step(const sim::Engine& engine, std::span<const sim::Event> beside, bool late);
  /// The run is held: the last step stands.
  void held(const sim::Engine& engine);

  /// Whether somebody wants to know what robots report, as far as was heard until the last step.
  [[nodiscard]] bool robots_asked() const noexcept { return asked_.robots; }

 private:
  struct Look {
    std::uint64_t number = 0;
    Asked asked;
    Clock::time_point heard;
  };
  Teller(Options options, bus::Reader<bus::Look> looks, bus::Writer<bus::RunEvents> events,
         ReadingTeller readings, bus::Writer<bus::MapTile> tiles,
         std::optional<ObstacleTeller> obstacles)
      : options_(std::move(options)),
        looks_(std::move(looks)),
        events_(std::move(events)),
        readings_(std::move(readings)),
        tiles_(std::move(tiles)),
        obstacles_(std::move(obstacles)) {}

  void hear(Clock::time_point now);
  void put(const sim::Event& event, SimTime time);
  void tell_events(const sim::Engine& engine, std::span<const sim::Event> beside);
  void tell_readings(const sim::Engine& engine, Clock::time_point now, int slower);
  void tell_maps(const sim::Engine& engine, Clock::time_point now, int slower);

  Options options_;
  bus::Reader<bus::Look> looks_;
  bus::Writer<bus::RunEvents> events_;
  ReadingTeller readings_;
  bus::Writer<bus::MapTile> tiles_;
  maps::LocalMaps maps_;
  probe::Probes probes_;
  std::optional<ObstacleTeller> obstacles_;
  std::map<std::uint64_t, Look> heard_;  ///< By who looks.
  Asked asked_;                          ///< By all together.
  Clock::time_point next_hearing_{};
  std::uint64_t number_ = 0;  ///< Of samples of events.
  std::vector<rave_wire_RunEvent> told_;
  std::uint32_t left_out_ = 0;
};

}  // namespace rave::onlook
