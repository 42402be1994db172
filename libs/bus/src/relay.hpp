// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

#include "rave/base/bell.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"

namespace rave::bus {

class LocalReceiver;

/// Waits for sockets and a DDS wait set at once. poll() cannot wait for DDS, so a thread does and
/// signals through a flag and an event descriptor. Datagrams do not pass that thread. Owner: a
/// WaitSet, which deletes the entities afterwards. Thread: its own.
class Relay {
 public:
  /// `bell`: a guard condition in the set. Error: kIo.
  [[nodiscard]] static Result<std::unique_ptr<Relay>> create(dds_entity_t set, dds_entity_t bell);
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;
  ~Relay();

  /// `receiver` must outlive the relay; it learns what ended a wait.
  void add(LocalReceiver& receiver);
  enum class Came : std::uint8_t { kNothing, kSocket, kSet };
  /// Waits; returns what to look at first. Negative `timeout`: without limit.
  [[nodiscard]] Came wait(Duration timeout);

 private:
  Relay(dds_entity_t set, dds_entity_t bell, Bell event)
      : set_(set),
        bell_(bell),
        event_(std::move(event)),
        polled_{{event_.descriptor(), POLLIN, 0}} {}
  void run() noexcept;
  /// Whether the set has a condition that holds; if so, tells the receivers.
  [[nodiscard]] bool ready() const;
  /// Whether a datagram arrives within this time. Returns early when the thread has answered.
  [[nodiscard]] bool look(Duration most);
  void tell_of_dds() const;
  /// Resets the request after an answer.
  void note_answer();

  dds_entity_t set_;
  dds_entity_t bell_;
  Bell event_;
  std::vector<pollfd> polled_;  ///< The event descriptor, then the sockets of the receivers.
  std::vector<LocalReceiver*> receivers_;
  std::chrono::steady_clock::time_point crowded_until_{};
  std::chrono::milliseconds crowded_for_{};
  bool asked_ = false;  ///< A request to the thread whose answer was not processed yet.
  /// The answer. The event descriptor only ends a sleep, possibly for an earlier answer.
  std::atomic<bool> answered_ = false;
  std::counting_semaphore<> ask_{0};
  std::atomic<bool> over_ = false;
  std::jthread thread_;
};

}  // namespace rave::bus
