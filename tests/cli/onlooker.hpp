// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::cli_test {

/// This process on the bus of a test's run. `apart`: the words that keep a test's run apart.
/// `beside`: it is there already, and joins once more.
[[nodiscard]] Result<std::unique_ptr<bus::Bus>> join_as_onlooker(
    const bus::RunId& run, const std::vector<std::string>& apart, bool beside = false);

/// Somebody who counts the steps of a run in lock-step, from this process.
class StepListener {
 public:
  [[nodiscard]] static Result<std::unique_ptr<StepListener>> open(
      const bus::RunId& run, const std::vector<std::string>& apart);

  /// Takes in what has come.
  void listen();
  /// The newest step that was seen; 0: none.
  [[nodiscard]] std::uint64_t step() const { return seen_.empty() ? 0 : seen_.back().step; }
  /// The newest step that had been seen at a moment.
  [[nodiscard]] std::uint64_t step_at(std::chrono::steady_clock::time_point when) const;

 private:
  struct Seen {
    std::chrono::steady_clock::time_point when;
    std::uint64_t step = 0;
  };
  StepListener(std::unique_ptr<bus::Bus> bus, bus::Reader<bus::WorldStep> worlds)
      : bus_(std::move(bus)), worlds_(std::move(worlds)) {}

  std::unique_ptr<bus::Bus> bus_;
  bus::Reader<bus::WorldStep> worlds_;
  std::vector<Seen> seen_;
};

}  // namespace rave::cli_test
