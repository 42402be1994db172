// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/robot/order.hpp"

namespace rave::manager {

/// The roster of a run: what the processes of its hosts publish about their robots (topic
/// rave/roster), as far as it agrees with the scenario. One owner thread.
class RosterBook {
 public:
  /// A robot at the start of the scenario.
  struct Robot {
    std::string name;
    bool simulated = true;
  };
  /// `robots`: all of them, by id.
  RosterBook(std::vector<Robot> robots, const std::vector<config::PlannedHost>& hosts);

  /// Processes an entry; the sample has passed bus::validate(). `serving`: the process that serves
  /// the host named in it; 0: none yet. An entry that disagrees with the scenario is dropped. An
  /// entry of another process than the serving one counts once that one has left and this one
  /// serves. Returns why an entry is refused, once per process; empty otherwise.
  [[nodiscard]] std::optional<std::string> hear(const bus::RosterEntry& entry,
                                                std::uint64_t serving);
  /// Forgets a process that has left, with all its entries.
  void lose(std::uint64_t writer);

  /// The number of a host; kNone: unknown name.
  [[nodiscard]] std::uint32_t host_of(std::size_t robot) const { return host_of_[robot]; }
  /// Whether a robot is simulated, according to the process `serving` its host; before that,
  /// according to the scenario.
  [[nodiscard]] bool simulated(std::size_t robot, std::uint64_t serving) const;
  /// The orders that it accepts, according to that process; none before its entry.
  [[nodiscard]] OrderSet takes(std::size_t robot, std::uint64_t serving) const;
  /// Who has its command lease, as that process says, and the page; empty: no person.
  [[nodiscard]] std::pair<std::string, std::uint64_t> driver(std::size_t robot,
                                                             std::uint64_t serving) const;
  [[nodiscard]] std::size_t robots() const noexcept { return robots_.size(); }
  /// Whether an entry was added or lost since the last call.
  [[nodiscard]] bool take_news() noexcept { return std::exchange(news_, false); }
  /// Call it when another process serves a host, or none does: the roster then differs.
  void stir() noexcept { news_ = true; }

 private:
  struct Said {
    bool simulated = true;
    OrderSet takes = 0;
    std::string driver{};
    std::uint64_t driver_page = 0;
  };
  /// The entries of one process, by robot.
  using Book = std::map<std::uint32_t, Said>;
  [[nodiscard]] const Said* said(std::size_t robot, std::uint64_t serving) const;
  [[nodiscard]] std::string wrong(const bus::RosterEntry& entry) const;
  [[nodiscard]] std::optional<std::string> once(std::uint64_t writer, std::string why);

  std::vector<Robot> robots_;
  std::vector<std::string> host_names_;
  std::vector<std::uint32_t> host_of_;  ///< By robot.
  std::map<std::uint64_t, Book> books_;
  std::set<std::uint64_t> told_;  ///< Processes with a refused entry; each is logged once.
  bool news_ = false;
};

/// The process that serves a host of the scenario; 0: none.
using Serving = std::function<std::uint64_t(std::uint32_t host)>;

/// Processes all entries that have arrived; refused ones are logged.
void read_roster(bus::Reader<bus::RosterEntry>& reader, RosterBook& book, const Serving& serving);

/// Updates the status of the run with the present reality and drivers of robots, if they have
/// changed. `control` has begun and shows all robots by id; may be null.
void show_kinds(RosterBook& book, const Serving& serving, runtime::RunControl* control);

}  // namespace rave::manager
