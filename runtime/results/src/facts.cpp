// SPDX-License-Identifier: Apache-2.0
#include "rave/results/facts.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace rave::runtime {
namespace {

template <class T>
void append(std::vector<T>& into, std::vector<T> from) {
  into.insert(into.end(), std::make_move_iterator(from.begin()),
              std::make_move_iterator(from.end()));
}

/// Appends, in the order of robots. A robot in both lists came back; its earlier entry is dropped.
template <class T>
void append_by_robot(std::vector<T>& into, std::vector<T> from) {
  const auto is_newer = [&from](const T& old) {
    return std::ranges::binary_search(from, old.robot, {}, &T::robot);
  };
  const bool apart = into.empty() || from.empty() || into.back().robot < from.front().robot;
  if (!apart) into.erase(std::remove_if(into.begin(), into.end(), is_newer), into.end());
  append(into, std::move(from));
  std::stable_sort(into.begin(), into.end(),
                   [](const T& a, const T& b) { return a.robot < b.robot; });
}

/// A change of an obstacle in real time: the obstacle and the number of the change.
using Change = std::pair<BodyId, std::uint32_t>;
/// The first event that a process reported for a change.
using Word = std::tuple<std::uint64_t, sim::EventKind, std::string>;

bool is_counted(const sim::Event& event) {
  return sim::is_of_obstacle(event.kind) && event.detail != 0;
}

std::map<Change, Word> words_of(const std::vector<sim::Event>& events) {
  std::map<Change, Word> words;
  for (const sim::Event& event : events) {
    if (!is_counted(event)) continue;
    Word word(event.step, event.kind, event.text);
    const auto [known, is_new] = words.try_emplace({event.other, event.detail}, word);
    // The earliest report of a change, so that the result is the same for any order of hosts.
    if (!is_new && word < known->second) known->second = std::move(word);
  }
  return words;
}

bool is_added(const sim::Event& event) {
  return event.kind == sim::EventKind::kObstacleAdded && is_counted(event);
}

/// The event that added each obstacle, which is that of its smallest change; only for obstacles
/// that some process reported as added.
std::map<BodyId, sim::Event> comings(const std::vector<sim::Event>& one,
                                     const std::vector<sim::Event>& other) {
  std::map<BodyId, sim::Event> comings;
  for (const auto* const events : {&one, &other}) {
    for (const sim::Event& event : *events) {
      if (!is_added(event)) continue;
      const auto [known, is_new] = comings.try_emplace(event.other, event);
      if (is_new) continue;
      const std::uint64_t step = std::min(known->second.step, event.step);
      if (event.detail < known->second.detail) known->second = event;
      known->second.step = step;
    }
  }
  return comings;
}

/// An obstacle is added only once. A process that learned of it only when it was moved or removed
/// reports that it was added with that change; if another process knows the change that really
/// added it, the event is turned back into what it was.
void tell_apart(const std::map<BodyId, sim::Event>& comings, std::vector<sim::Event>& events) {
  std::set<Change> removals;
  for (const sim::Event& event : events) {
    const bool removed = event.kind == sim::EventKind::kObstacleRemoved && is_counted(event);
    if (removed) removals.insert({event.other, event.detail});
  }
  const auto came_before = [&comings](const sim::Event& event) {
    return is_added(event) && comings.at(event.other).detail < event.detail;
  };
  std::erase_if(events, [&](const sim::Event& event) {
    return came_before(event) && removals.contains({event.other, event.detail});
  });
  for (sim::Event& event : events) {
    if (!is_added(event)) continue;
    if (came_before(event)) {
      event.kind = sim::EventKind::kObstacleMoved;
    } else {
      event.step = comings.at(event.other).step;
    }
  }
}

/// In real time each host receives a change at its own time, and a late one receives several as
/// one: of each change the earliest report counts.
void keep_first_words(std::vector<sim::Event>& from, std::vector<sim::Event>& into) {
  const std::map<Change, Word> here = words_of(into);
  std::set<Change> sooner;
  std::set<Change> later;
  for (const auto& [change, word] : words_of(from)) {
    const auto known = here.find(change);
    if (known == here.end()) continue;
    (word < known->second ? sooner : later).insert(change);
  }
  const auto drop = [](const std::set<Change>& which, std::vector<sim::Event>& events) {
    std::erase_if(events, [&which](const sim::Event& event) {
      return is_counted(event) && which.contains({event.other, event.detail});
    });
  };
  drop(later, from);
  drop(sooner, into);
}

void merge_events(std::vector<sim::Event> from, std::vector<sim::Event>& into) {
  const std::map<BodyId, sim::Event> came = comings(from, into);
  tell_apart(came, from);
  tell_apart(came, into);
  keep_first_words(from, into);
  append(into, std::move(from));
  // In the order of a single engine, followed by the sightings of observers.
  std::stable_sort(into.begin(), into.end(), [](const sim::Event& a, const sim::Event& b) {
    const bool a_seen = a.kind == sim::EventKind::kCaptured;
    const bool b_seen = b.kind == sim::EventKind::kCaptured;
    if (a.step != b.step || a_seen != b_seen || a_seen) {
      return std::tie(a.step, a_seen) < std::tie(b.step, b_seen);
    }
    return std::tie(a.robot, a.kind, a.other, a.text) < std::tie(b.robot, b.kind, b.other, b.text);
  });
  // Without a manager each host makes the scheduled changes of the world itself, so they are
  // reported several times.
  const auto same = [](const sim::Event& a, const sim::Event& b) {
    return !a.robot.valid() && !b.robot.valid() && a.step == b.step && a.kind == b.kind &&
           a.other == b.other && a.text == b.text;
  };
  into.erase(std::unique(into.begin(), into.end(), same), into.end());
}

void merge_closest(const std::map<std::string, Encounter>& from,
                   std::map<std::string, Encounter>& into) {
  for (const auto& [pair, found] : from) {
    const auto [known, is_new] = into.try_emplace(pair, found);
    Encounter& best = known->second;
    // Of equal distances, the one that a single engine would have found first.
    const bool nearer =
        std::tie(found.gap_m, found.time_s, found.a) < std::tie(best.gap_m, best.time_s, best.a);
    if (!is_new && nearer) best = found;
  }
}

void merge_goals(const GoalFacts& from, GoalFacts& into) {
  into.touches.resize(std::max(into.touches.size(), from.touches.size()));
  for (std::size_t i = 0; i < from.touches.size(); ++i) into.touches[i] += from.touches[i];
  into.silent.resize(std::max(into.silent.size(), from.silent.size()));
  for (std::size_t i = 0; i < from.silent.size(); ++i) {
    append(into.silent[i], from.silent[i]);
    std::ranges::sort(into.silent[i]);
  }
  into.arrivals.resize(std::max(into.arrivals.size(), from.arrivals.size()));
  for (std::size_t i = 0; i < from.arrivals.size(); ++i) {
    const ArrivalFacts& found = from.arrivals[i];
    ArrivalFacts& arrival = into.arrivals[i];
    if (!found.known) continue;
    arrival.nearest_m =
        arrival.known ? std::min(arrival.nearest_m, found.nearest_m) : found.nearest_m;
    arrival.known = true;
    // A robot that came back under another process may have two reports; the first arrival counts.
    const bool earlier = found.time_s && (!arrival.time_s || *found.time_s < *arrival.time_s);
    if (earlier) arrival.time_s = found.time_s;
  }
}

void merge_sightings(const std::optional<SightingFacts>& from, std::optional<SightingFacts>& into) {
  if (!from) return;
  if (!into) into.emplace();
  for (const auto& [robot, tally] : from->by_robot) into->by_robot[robot] += tally;
  for (const auto& [code, count] : from->unknown_codes) into->unknown_codes[code] += count;
}

void merge_captures(const std::optional<CaptureFacts>& from, std::optional<CaptureFacts>& into) {
  if (!from) return;
  if (!into) into.emplace();
  append(into->captures, from->captures);
  std::stable_sort(into->captures.begin(), into->captures.end(),
                   [](const Capture& a, const Capture& b) { return a.time_s < b.time_s; });
  if (!into->closest_m || from->closest_m.value_or(*into->closest_m) < *into->closest_m) {
    into->closest_m = from->closest_m;
  }
}

void merge_tracks(std::vector<TrackFacts> from, std::vector<TrackFacts>& into) {
  append(into, std::move(from));
  std::stable_sort(into.begin(), into.end(), [](const TrackFacts& a, const TrackFacts& b) {
    return std::tie(a.track.odometry_only, a.robot) < std::tie(b.track.odometry_only, b.robot);
  });
}

void merge_instant(std::optional<InstantFacts> from, std::optional<InstantFacts>& into) {
  if (!from) return;
  if (!into) {
    into = std::move(from);
    return;
  }
  append_by_robot(into->robots, std::move(from->robots));
  append(into->sightings, std::move(from->sightings));
  std::stable_sort(into->sightings.begin(), into->sightings.end(),
                   [](const auto& a, const auto& b) {
                     return std::tie(a.step, a.robot) < std::tie(b.step, b.robot);
                   });
}

/// Of several reports on the world the most complete one counts.
void merge_world(std::optional<WorldFacts> from, std::optional<WorldFacts>& into) {
  if (!from) return;
  const bool more = !into || from->first_step < into->first_step ||
                    (from->first_step == into->first_step && from->next_step > into->next_step);
  if (more) into = std::move(from);
}

}  // namespace

// The facts of all processes are merged into those that one process would have gathered. Counts are
// added, extremes compared, and lists sorted as a single engine would have ordered them. So results
// do not depend on the number of hosts or on the order in which their results arrive.
void merge(RunFacts from, RunFacts& into) {
  into.first_step = std::min(into.first_step, from.first_step);
  into.steps = std::max(into.steps, from.steps);
  into.has_world = into.has_world || from.has_world;
  into.world_from = std::max(into.world_from, from.world_from);
  append(into.problems, std::move(from.problems));
  merge_events(std::move(from.events), into.events);
  append_by_robot(into.robots, std::move(from.robots));
  append_by_robot(into.devices, std::move(from.devices));
  append_by_robot(into.streams, std::move(from.streams));
  append_by_robot(into.transmitters, std::move(from.transmitters));
  into.radio += from.radio;
  into.inputs_by_hand += from.inputs_by_hand;
  into.lateness += from.lateness;
  into.poses.count += from.poses.count;
  into.poses.slowest_ns = std::max(into.poses.slowest_ns, from.poses.slowest_ns);
  into.poses.sum_ns += from.poses.sum_ns;
  for (const auto& [who, counts] : from.hits) {
    for (const auto& [what, count] : counts) into.hits[who][what] += count;
  }
  merge_closest(from.closest, into.closest);
  merge_goals(from.goals, into.goals);
  merge_sightings(from.sightings, into.sightings);
  merge_captures(from.capture, into.capture);
  merge_tracks(std::move(from.tracks), into.tracks);
  merge_instant(std::move(from.instant), into.instant);
  append_by_robot(into.shadows, std::move(from.shadows));
  append_by_robot(into.maps, std::move(from.maps));
  merge_world(std::move(from.world), into.world);
}

}  // namespace rave::runtime
