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

/// How long to wait so as to be awake at `when`; 0 if that is over.
[[nodiscard]] inline Duration left_until(std::chrono::steady_clock::time_point when) {
  const auto left =
      std::chrono::duration_cast<std::chrono::nanoseconds>(when - std::chrono::steady_clock::now());
  return Duration{std::max<std::int64_t>(0, left.count())};
}

enum class Woken : std::uint8_t { kReady, kTimeout, kStopped };

/// Sleeps until there is something to take. Must be gone before its bus and after no reader that it
/// waits for. Thread: that of the bus; the stop may be requested and
/// the bell rung by any.
class WaitSet {
 public:
  [[nodiscard]] static Result<WaitSet> create(Bus& bus);
  WaitSet(WaitSet&& other) noexcept;
  WaitSet& operator=(WaitSet&&) = delete;
  ~WaitSet();

  /// Wakes when the reader has samples, until they are taken.
  template <class Message>
  [[nodiscard]] Status add(const Reader<Message>& reader) {
    return add_reader(reader.handle());
  }
  /// Wakes when a participant comes or goes, or when an end of a writer or reader that exists now
  /// matches or not, until Bus::take_events() is called.
  [[nodiscard]] Status add_events();

  /// Ends the wait that goes on, or else the next one, as kReady. Any thread.
  void ring() const noexcept;

  /// `timeout` below 0 waits for ever. kReady if several apply.
  [[nodiscard]] Woken wait(Duration timeout, const std::stop_token& stop = {});

 private:
  explicit WaitSet(Bus& bus);
  [[nodiscard]] Status add_reader(dds_entity_t reader);
  [[nodiscard]] Status attach(dds_entity_t entity);

  Bus* bus_;
  dds_entity_t set_ = 0;
  dds_entity_t stop_ = 0;
  dds_entity_t bell_ = 0;
  std::unique_ptr<Relay> relay_;  ///< Only where a reader has a short way.
  std::vector<dds_entity_t> conditions_;
};

}  // namespace rave::bus
