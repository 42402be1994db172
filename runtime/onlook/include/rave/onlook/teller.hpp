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

/// The host's side of observation: receives requests of monitors and publishes readings, events,
/// obstacles and local maps. Robots and programs do not depend on it, and it does not block.
/// Without requests it publishes only rare events and obstacles, for monitors that start later.
/// Destroy it before its bus; thread: that of the bus.
class Teller {
 public:
  using Clock = std::chrono::steady_clock;

  /// Limit of published contacts per step; further ones are only counted.
  static constexpr std::size_t kMostContacts = 100;

  struct Options {
    std::uint32_t host = 0;  ///< Number of the host in the scenario.
    /// Whether to publish obstacles: no other process on this bus does it for this host.
    bool obstacles = true;
    /// The description of an event, after the name of its kind. Empty: its text.
    std::function<std::string(const sim::Event&)> words = {};
    /// Source of the drivers of probes; must outlive the teller. Null: no probes.
    plugin::Catalogue* catalogue = nullptr;
  };
  /// Errors: those of bus::Writer::create() and bus::Reader::create().
  [[nodiscard]] static Result<Teller> create(bus::Bus& bus, Options options);

  /// Call it before the first step.
  void begin(const sim::EngineSpec& spec) {
    if (obstacles_) obstacles_->begin(spec);
  }
  /// Call it after each step. `beside`: events that the engine does not have. `late`: steps are
  /// late, so less is published.
  void after_step(const sim::Engine& engine, std::span<const sim::Event> beside, bool late);
  /// Call it while the run is paused.
  void held(const sim::Engine& engine);

  /// Whether a monitor requests robot states, as of the last step.
  [[nodiscard]] bool robots_asked() const noexcept { return asked_.robots; }

 private:
  struct Look {
    std::uint64_t number = 0;
    Asked asked;
    Clock::time_point heard;
  };
  Teller(Options options, ReadingTeller readings, std::optional<ObstacleTeller> obstacles)
      : options_(std::move(options)),
        readings_(std::move(readings)),
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
  std::map<std::uint64_t, Look> heard_;  ///< By monitor.
  Asked asked_;                          ///< Union of all requests.
  Clock::time_point next_hearing_{};
  std::vector<rave_wire_RunEvent> told_;
  std::uint32_t left_out_ = 0;
};

}  // namespace rave::onlook
