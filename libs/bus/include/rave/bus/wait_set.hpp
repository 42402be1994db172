// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/bus/reader.hpp"

namespace rave::bus {

class Relay;

/// The time from now until `when`; 0 if `when` is past.
[[nodiscard]] inline Duration left_until(std::chrono::steady_clock::time_point when) {
  const auto left =
      std::chrono::duration_cast<std::chrono::nanoseconds>(when - std::chrono::steady_clock::now());
  return Duration{std::max<std::int64_t>(0, left.count())};
}

enum class Woken : std::uint8_t { kReady, kTimeout, kStopped };

/// Blocks until one of its conditions holds. Destroy it before its bus and before the readers that
/// it waits for. Thread: that of the bus; any thread may request the stop and call ring().
class WaitSet {
 public:
  [[nodiscard]] static Result<WaitSet> create(Bus& bus);
  /// Only to be assigned to.
  WaitSet();
  WaitSet(WaitSet&& other) noexcept;
  WaitSet& operator=(WaitSet&& other) noexcept;
  ~WaitSet();

  /// Wakes while one of the readers has samples that were not taken.
  template <class... Messages>
  [[nodiscard]] Status add(const Reader<Messages>&... readers) {
    Status status;
    static_cast<void>(((status = add_reader(readers.handle())).has_value() && ...));
    return status;
  }
  /// Wakes when a participant appears or leaves, or when a match of a present writer or reader
  /// changes, until Bus::take_events() is called.
  [[nodiscard]] Status add_events();

  /// Ends the current wait, or else the next one, with kReady. Any thread.
  void ring() const noexcept;

  /// Waits for at most `timeout`; negative: without limit. Returns kReady if several outcomes
  /// apply.
  [[nodiscard]] Woken wait(Duration timeout, const std::stop_token& stop = {});

 private:
  [[nodiscard]] Status add_reader(dds_entity_t reader);
  [[nodiscard]] Status attach(dds_entity_t entity);

  Bus* bus_ = nullptr;
  dds_entity_t set_ = 0;
  dds_entity_t stop_ = 0;
  dds_entity_t bell_ = 0;
  std::unique_ptr<Relay> relay_;  ///< Only if a reader uses the local transport.
  std::vector<dds_entity_t> conditions_;
};

}  // namespace rave::bus
