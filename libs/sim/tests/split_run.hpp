// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <tuple>

#include "rave/sim/world_authority.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

/// Worlds that several engines and one authority share, in one process, for tests.
namespace rave::sim::testing {

/// Runs one world on several hosts, as messages between processes would.
class SplitRun {
 public:
  /// `make` gives the same spec each time.
  template <class Make>
  SplitRun(Make make, const std::vector<std::uint32_t>& host_of) {
    auto made = WorldAuthority::create(make(), host_of);
    if (!made) {
      ADD_FAILURE() << made.error().text();
      return;
    }
    authority = *std::move(made);
    reports.resize(std::size_t{1} + *std::ranges::max_element(host_of));
    for (std::uint32_t host = 0; host < reports.size(); ++host) {
      EngineSpec spec = make();
      spec.local.emplace();
      for (std::uint32_t r = 0; r < host_of.size(); ++r) {
        if (host_of[r] == host) spec.local->emplace_back(r);
      }
      hosts.push_back(make_engine(std::move(spec)));
      reports[host].host = host;
    }
    exchange();
  }

  /// One step of all; true if it went well.
  bool advance() { return apply() && exchange(); }

  bool apply() {
    for (auto& host : hosts) {
      const Status status = host->apply(world);
      if (!status) ADD_FAILURE() << status.error().text();
      if (!status) return false;
    }
    return true;
  }

  /// Reports to the authority and what it says to them.
  bool exchange() {
    order.clear();
    for (std::size_t h = 0; h < hosts.size(); ++h) {
      const Status status = hosts[h]->propose(reports[h]);
      if (!status) ADD_FAILURE() << status.error().text();
      order.push_back(&reports[h]);
    }
    if (asks) asks(reports);
    // In another order each time.
    std::rotate(order.begin(), order.begin() + static_cast<long>(shift++ % order.size()),
                order.end());
    if (shift % 2 == 0) std::reverse(order.begin(), order.end());
    const Status status = authority->step(order, world);
    if (!status) ADD_FAILURE() << status.error().text();
    return status.has_value();
  }

  [[nodiscard]] RunHash hash() const {
    RunHash sum = authority->hash();
    for (const auto& host : hosts) sum.merge(host->hash());
    return sum;
  }

  /// Of the last step, in the order of an engine that is alone.
  [[nodiscard]] std::vector<Event> events() const {
    std::vector<Event> all(authority->events().begin(), authority->events().end());
    for (const auto& host : hosts) {
      all.insert(all.end(), host->events().begin(), host->events().end());
    }
    std::sort(all.begin(), all.end(), [](const Event& a, const Event& b) {
      return std::tie(a.robot, a.kind, a.other, a.text) <
             std::tie(b.robot, b.kind, b.other, b.text);
    });
    return all;
  }

  [[nodiscard]] RadioCounts radio_counts() const {
    RadioCounts sum;
    for (const auto& host : hosts) sum += host->radio_counts();
    return sum;
  }

  std::unique_ptr<WorldAuthority> authority;
  std::vector<std::unique_ptr<Engine>> hosts;
  std::vector<HostReport> reports;
  WorldStep world;
  /// Adds to the reports what people have asked of the hosts; may be empty.
  std::function<void(std::vector<HostReport>&)> asks;
  std::vector<const HostReport*> order;
  std::size_t shift = 0;
};

}  // namespace rave::sim::testing
