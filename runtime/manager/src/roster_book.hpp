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

/// The roster of a run: what the processes of its hosts say of their robots (topic rave/roster), as
/// far as it agrees with the scenario. One owner thread.
class RosterBook {
 public:
  /// A robot as the scenario has it at the start.
  struct Robot {
    std::string name;
    bool simulated = true;
  };
  /// `robots`: all of them, by id.
  RosterBook(std::vector<Robot> robots, const std::vector<config::PlannedHost>& hosts);

  /// Takes in what a process says of a robot; the sample has passed bus::validate(). `serving`: the
  /// process that serves the host which it names; 0: nobody yet. What does not agree with the
  /// scenario is dropped; what comes from another process than that which serves counts when that
  /// one is gone and this one serves. Returns why it is refused, for each process once; nothing
  /// otherwise.
  [[nodiscard]] std::optional<std::string> hear(const bus::RosterEntry& entry,
                                                std::uint64_t serving);
  /// A process is gone, with all that it said.
  void lose(std::uint64_t writer);

  /// The number of a host; kNone: there is none.
  [[nodiscard]] std::uint32_t host_of(std::size_t robot) const { return host_of_[robot]; }
  /// Whether a robot is simulated, as the process `serving` its host says; else as at the start.
  [[nodiscard]] bool simulated(std::size_t robot, std::uint64_t serving) const;
  /// Which orders of people it takes, as that process says; none before it does.
  [[nodiscard]] OrderSet takes(std::size_t robot, std::uint64_t serving) const;
  /// Who has its command lease, as that process says, and the page; empty: nobody.
  [[nodiscard]] std::pair<std::string, std::uint64_t> driver(std::size_t robot,
                                                             std::uint64_t serving) const;
  [[nodiscard]] std::size_t robots() const noexcept { return robots_.size(); }
  /// Whether anything was taken in, or lost, since the last call.
  [[nodiscard]] bool take_news() noexcept { return std::exchange(news_, false); }
  /// Another process serves a host now, or none does: that is news, too.
  void stir() noexcept { news_ = true; }

 private:
  struct Said {
    bool simulated = true;
    OrderSet takes = 0;
    std::string driver{};
    std::uint64_t driver_page = 0;
  };
  /// What one process said, by robot.
  using Book = std::map<std::uint32_t, Said>;
  [[nodiscard]] const Said* said(std::size_t robot, std::uint64_t serving) const;
  [[nodiscard]] std::string wrong(const bus::RosterEntry& entry) const;
  [[nodiscard]] std::optional<std::string> once(std::uint64_t writer, std::string why);

  std::vector<Robot> robots_;
  std::vector<std::string> host_names_;
  std::vector<std::uint32_t> host_of_;  ///< By robot.
  std::map<std::uint64_t, Book> books_;
  std::set<std::uint64_t> told_;  ///< Processes that were refused something.
  bool news_ = false;
};

/// The process that serves a host of the scenario; 0: none.
using Serving = std::function<std::uint64_t(std::uint32_t host)>;

/// Takes in all that has come; what is refused is told by the bus.
void read_roster(bus::Reader<bus::RosterEntry>& reader, RosterBook& book, const Serving& serving);

/// Tells whoever asks for the status of the run which robots are real now and who drives them, if
/// there is news.
/// `control` has begun and shows all robots by id; may be null.
void show_kinds(RosterBook& book, const Serving& serving, runtime::RunControl* control);

}  // namespace rave::manager
