// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/realities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rave::real_time {
namespace {

/// Limits the memory that a sender with invented processes can use.
constexpr std::size_t kMostBooks = 1024;

}  // namespace

Result<Realities> Realities::create(bus::Bus& bus, std::uint32_t own_host,
                                    std::vector<std::uint32_t> host_of) {
  RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::RosterEntry>::create(bus));
  return Realities(own_host, std::move(host_of), std::move(reader));
}

void Realities::hear() {
  reader_.take([this](const bus::RosterEntry& entry) { hear(entry); });
}

void Realities::hear(const bus::RosterEntry& entry) {
  if (entry.host == own_host_) return;
  // A shadow is a copy beside the robot, which says nothing about the robot's own drivers.
  const bool fits = entry.robot < host_of_.size() && host_of_[entry.robot] == entry.host &&
                    entry.kind != rave_wire_ROBOT_SHADOW;
  if (!fits) {
    // One event: such a process would otherwise fill the log with each of its robots.
    if (std::exchange(refused_, true)) return;
    reader_.refuse(entry, fmt::format("robot {} does not run on host {}, or is a shadow",
                                      entry.robot, entry.host));
    return;
  }
  auto book = std::ranges::find(books_, entry.writer, &Book::writer);
  if (book == books_.end()) {
    if (books_.size() >= kMostBooks) return;
    book = books_.insert(books_.end(), {entry.writer, entry.host, {}});
  }
  if (book->host != entry.host) return;
  book->said[RobotId(entry.robot)] = entry.kind == rave_wire_ROBOT_SIMULATED;
}

void Realities::lose(std::uint64_t writer) {
  std::erase_if(books_, [writer](const Book& book) { return book.writer == writer; });
}

std::vector<RobotReality> Realities::take() {
  // Books are in the order in which their processes appeared, so the first book of a host wins. If
  // its process is lost, the next one takes its place here.
  std::map<RobotId, bool> now;
  std::set<std::uint32_t> served;
  for (const Book& book : books_) {
    if (served.insert(book.host).second) now.insert(book.said.begin(), book.said.end());
  }
  std::vector<RobotReality> realities;
  for (const auto& [robot, simulated] : now) {
    const auto [shown, is_new] = shown_.try_emplace(robot, simulated);
    if (!is_new && std::exchange(shown->second, simulated) == simulated) continue;
    realities.push_back({robot, simulated});
  }
  return realities;
}

}  // namespace rave::real_time
