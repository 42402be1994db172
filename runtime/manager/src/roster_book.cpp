// SPDX-License-Identifier: Apache-2.0
#include "roster_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "rave/bus/sequence.hpp"
#include "rave/control/order_words.hpp"

namespace rave::manager {
namespace {

/// Bounds the memory if processes are forged; besides the serving ones, some may be restarting.
constexpr std::size_t kMoreBooks = 64;
constexpr std::size_t kMostRefused = 1000;

/// A name as the wire carries it.
std::string on_the_wire(const std::string& name) {
  bus::RosterEntry entry{};
  bus::put_text(entry.name, name);
  return entry.name;
}

}  // namespace

RosterBook::RosterBook(std::vector<Robot> robots, const std::vector<config::PlannedHost>& hosts)
    : robots_(std::move(robots)), host_of_(robots_.size(), rave_wire_kNone) {
  // The wire cuts long names, so names of the scenario are cut in the same way before they are
  // compared.
  for (Robot& robot : robots_) robot.name = on_the_wire(robot.name);
  for (std::uint32_t h = 0; h < hosts.size(); ++h) {
    host_names_.push_back(hosts[h].name);
    for (const std::size_t robot : hosts[h].robots) host_of_[robot] = h;
  }
}

std::string RosterBook::wrong(const bus::RosterEntry& entry) const {
  if (entry.robot >= robots_.size()) {
    return fmt::format("robot {} is not one of the {} of the scenario", entry.robot,
                       robots_.size());
  }
  const std::uint32_t host = host_of_[entry.robot];
  const std::string& name = robots_[entry.robot].name;
  if (entry.host == host && name == entry.name) return {};
  const auto host_text = [this](std::uint32_t number) {
    return number < host_names_.size() ? "`" + host_names_[number] + "`"
                                       : fmt::format("{}, which does not exist", number);
  };
  return fmt::format("robot {} was reported as `{}` on host {}; in the scenario it is `{}` on {}",
                     entry.robot, entry.name, host_text(entry.host), name, host_text(host));
}

std::optional<std::string> RosterBook::once(std::uint64_t writer, std::string why) {
  if (told_.size() >= kMostRefused || !told_.insert(writer).second) return std::nullopt;
  return why;
}

std::optional<std::string> RosterBook::hear(const bus::RosterEntry& entry, std::uint64_t serving) {
  if (std::string why = wrong(entry); !why.empty()) return once(entry.writer, std::move(why));
  // A process that is about to replace the present one may describe its robots before it gets the
  // slot, so books of other processes are kept, in limited number.
  const bool room =
      books_.size() < host_names_.size() + kMoreBooks || books_.contains(entry.writer);
  if (room || entry.writer == serving) {
    books_[entry.writer][entry.robot] = {entry.kind == rave_wire_ROBOT_SIMULATED, entry.takes,
                                         entry.driver, entry.driver_page};
    news_ = true;
  }
  // A free slot: the process that sent this may take it next.
  if (serving == 0 || serving == entry.writer) return std::nullopt;
  return once(entry.writer,
              fmt::format("a second robot `{}`: its host `{}` is served by process {:016x}",
                          entry.name, host_names_[entry.host], serving));
}

void RosterBook::lose(std::uint64_t writer) {
  news_ = books_.erase(writer) > 0 || news_;
  told_.erase(writer);
}

const RosterBook::Said* RosterBook::said(std::size_t robot, std::uint64_t serving) const {
  const auto book = books_.find(serving);
  if (book == books_.end()) return nullptr;
  const auto found = book->second.find(static_cast<std::uint32_t>(robot));
  return found == book->second.end() ? nullptr : &found->second;
}

bool RosterBook::simulated(std::size_t robot, std::uint64_t serving) const {
  const Said* const its = said(robot, serving);
  // Until the host has described the robot, the scenario counts.
  return its != nullptr ? its->simulated : robots_[robot].simulated;
}

OrderSet RosterBook::takes(std::size_t robot, std::uint64_t serving) const {
  const Said* const its = said(robot, serving);
  return its != nullptr ? its->takes : 0;
}

std::pair<std::string, std::uint64_t> RosterBook::driver(std::size_t robot,
                                                         std::uint64_t serving) const {
  const Said* const its = said(robot, serving);
  return its != nullptr ? std::pair(its->driver, its->driver_page)
                        : std::pair(std::string(), std::uint64_t{0});
}

void read_roster(bus::Reader<bus::RosterEntry>& reader, RosterBook& book, const Serving& serving) {
  reader.take([&](const bus::RosterEntry& entry) {
    if (const auto why = book.hear(entry, serving(entry.host))) reader.refuse(entry, *why);
  });
}

void show_kinds(RosterBook& book, const Serving& serving, runtime::RunControl* control) {
  if (control == nullptr || !book.take_news()) return;
  control->refresh([&](runtime::RunStatus& status) {
    const std::size_t robots = std::min(status.robots.size(), book.robots());
    for (std::size_t r = 0; r < robots; ++r) {
      const std::uint64_t by = serving(book.host_of(r));
      status.robots[r].simulated = book.simulated(r, by);
      runtime::write_takes(book.takes(r, by), status.robots[r].takes);
      std::tie(status.robots[r].lease, status.robots[r].lease_page) = book.driver(r, by);
    }
  });
}

}  // namespace rave::manager
