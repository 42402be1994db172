// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/topics.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::lock_step {

/// Limit of the results of one host, in bytes.
inline constexpr std::uint64_t kMostHostResults =
    std::uint64_t{rave_wire_kMaxHostResultsPart} * rave_wire_kMaxHostResultsParts;

/// How long a host waits until a manager has received its results, after it has written its
/// own files. A manager waits for present hosts for 20 s from the end of the run.
inline constexpr Duration kHostResultsPatience{10'000'000'000};

/// The results of one process of a run after its end, as bytes for the results of the whole run.
struct HostResults {
  std::uint64_t writer = 0;
  std::uint32_t host = 0;  ///< Number of the host in the scenario.
  std::vector<std::byte> bytes;
};

/// The host's side of the topic rave/host_results. Destroy it before its bus; thread: that of the
/// bus.
class HostResultsSender {
 public:
  /// Comes before any send(). Errors: those of bus::Writer::open().
  [[nodiscard]] Status open(bus::Bus& bus) { return writer_.open(bus); }

  /// Sends the results once, and waits until all present managers have acknowledged them, at
  /// most for `patience`. Errors: kInvalidArgument (empty, or more than kMostHostResults), kTimeout
  /// (a receiver does not keep up), kState (no receiver, or it has left).
  [[nodiscard]] Status send(std::uint32_t host, std::span<const std::byte> bytes,
                            Duration patience);
  /// The number of managers that listen.
  [[nodiscard]] std::size_t readers() const { return writer_.readers(); }

 private:
  bus::Writer<bus::HostResultsPart> writer_;
};

/// Assembles results from their parts. Independent of the bus.
class HostResultsParts {
 public:
  /// Adds a part that has passed validate(). Duplicates and out-of-range parts are ignored. Errors:
  /// kInvalidArgument (it contradicts an earlier part of the same process), kParse (all parts are
  /// present but the checksum does not match; further parts of that process are dropped).
  [[nodiscard]] Status add(const bus::HostResultsPart& part);
  /// Whether the results of a process are complete, or can never be.
  [[nodiscard]] bool done_with(std::uint64_t writer) const { return done_.contains(writer); }
  /// The completed results, in order of completion; each is returned once.
  [[nodiscard]] std::vector<HostResults> hand_out();

 private:
  struct Partial {
    std::uint32_t host = 0;
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
    std::map<std::uint32_t, std::vector<std::byte>> parts;
  };
  Status finish(std::uint64_t writer, Partial partial);

  std::map<std::uint64_t, Partial> partial_;  ///< By process.
  std::set<std::uint64_t> done_;
  std::vector<HostResults> whole_;
};

/// The manager's side. Destroy it before its bus; thread: that of the bus.
class HostResultsCollector {
 public:
  /// Comes before any take(). Errors: those of bus::Reader::open().
  [[nodiscard]] Status open(bus::Bus& bus) { return reader_.open(bus); }
  [[nodiscard]] Status wake(bus::WaitSet& waits) { return waits.add(reader_); }

  /// Receives parts. Those of a process for which `served(writer, host)` is false, because it did
  /// not have the place of this host, are refused.
  void take(const std::function<bool(std::uint64_t, std::uint32_t)>& served);
  [[nodiscard]] bool done_with(std::uint64_t writer) const { return parts_.done_with(writer); }
  [[nodiscard]] std::vector<HostResults> hand_out() { return parts_.hand_out(); }

 private:
  bus::Reader<bus::HostResultsPart> reader_;
  HostResultsParts parts_;
};

}  // namespace rave::lock_step
