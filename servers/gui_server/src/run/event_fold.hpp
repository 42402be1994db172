// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// Makes the log of a run: sentences for people, repetitions folded into one row with a count.
class EventFold {
 public:
  /// The number of rows that are kept. What is of less weight than a warning is left out beyond the
  /// first, and everything beyond the second; a row says how much.
  static constexpr std::size_t kMostEvents = 20'000;
  static constexpr std::size_t kMostInAll = 40'000;

  /// Names of the robots by slot.
  explicit EventFold(std::vector<std::string> names);

  /// `slot`: none (-1) if it concerns the world. `text` as the engine gives it: `with NAME` of a
  /// contact, a sentence of others. Events come in order of time.
  void add(double t_s, int slot, std::string_view kind, std::string_view text);

  [[nodiscard]] const std::vector<LogEvent>& events() const noexcept { return events_; }
  /// Another number after each add().
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// The first event that came or changed since then; with none, how many there are.
  [[nodiscard]] std::size_t changed_since(std::uint64_t revision) const noexcept;

 private:
  void leave_out(double t_s);

  std::vector<std::string> names_;
  std::map<std::string, std::uint32_t, std::less<>> slots_;
  std::vector<LogEvent> events_;
  std::vector<std::uint64_t> changed_;  ///< By event: the revision of its last change.
  std::uint64_t revision_ = 0;
  std::uint64_t left_out_ = 0;
  std::size_t full_ = 0;                     ///< The row that says so, if any was.
  std::map<std::string, std::size_t> last_;  ///< By sentence: the event that may continue.
};

}  // namespace rave::gui_server
