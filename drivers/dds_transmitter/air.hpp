// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "dds_transmitter/air_options.hpp"
#include "dds_transmitter/air_sample.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/robot/transmitter.hpp"

namespace rave::dds_transmitter {

/// Counters of an air. A value.
struct AirCounts {
  std::uint64_t sent = 0;
  std::uint64_t not_sent = 0;  ///< The queue was full, or DDS refused it.
  std::uint64_t received = 0;
  std::uint64_t refused = 0;  ///< Samples that are not valid packets.
  std::uint64_t foreign = 0;  ///< Samples of other runs.
  std::uint64_t others = 0;   ///< Processes that currently match this one.
};

/// One robot in an air: its receiver and its log.
struct AirPlace {
  PacketSink* sink = nullptr;
  std::uint32_t network = 0;
  HostServices host;
};

/// The connection of this process to one network: one participant and one thread for all robots of
/// the process whose transmitters have equal options. Robots of the process receive each other's
/// packets directly. All functions may be called from any thread.
class Air {
 public:
  /// Returns the process's air with these options, or creates it. Errors: those of
  /// bus::Bus::open().
  [[nodiscard]] static Result<std::shared_ptr<Air>> join(const AirOptions& options);
  Air(const Air&) = delete;
  Air& operator=(const Air&) = delete;
  ~Air() = default;

  /// Begins to pass received packets to the place. The first call starts the thread. Error: kIo.
  [[nodiscard]] Status attach(const AirPlace& place);
  /// Ends that; after its return the place receives nothing. The last call ends the thread.
  void detach(const AirPlace& place);
  /// Passes a packet to all other places of this process and, through the thread, to other
  /// processes. Errors: kInvalidArgument (not a packet, or too long), kIo (the queue is full).
  [[nodiscard]] Status send(std::span<const std::byte> bytes, const AirPlace& from);
  [[nodiscard]] AirCounts counts() const;

 private:
  /// Packets waiting for the thread: their bytes, concatenated.
  struct Queue {
    std::vector<std::byte> bytes;
    std::vector<std::size_t> sizes;
  };

  explicit Air(const AirOptions& options) : options_(options) {}
  Status open();
  void run(const std::stop_token& stop);
  void write_waiting();
  void take();
  void hand_out(const bus::Packet& sample);
  void look();
  void tell(LogLevel level, const std::string& text);

  const AirOptions options_;
  // Used by the thread while it runs, otherwise by attach() and detach(). Declared after the
  // members they need.
  std::unique_ptr<bus::Bus> bus_;
  std::optional<bus::Writer<bus::Packet>> writer_;
  std::optional<bus::Reader<bus::Packet>> reader_;
  std::optional<bus::WaitSet> waits_;
  Queue writing_;
  std::vector<std::byte> encoded_;
  std::uint64_t number_ = 0;
  std::set<std::uint64_t> complained_of_;  ///< Writers.

  mutable std::mutex places_mutex_;  // guards places_; held while sinks are called
  std::vector<AirPlace> places_;
  mutable std::mutex queue_mutex_;  // guards waiting_ and counts_
  Queue waiting_;
  AirCounts counts_;
  std::mutex thread_mutex_;  // serialises attach() and detach()
  std::jthread thread_;      // last member: it ends before the members it uses are destroyed
};

}  // namespace rave::dds_transmitter
