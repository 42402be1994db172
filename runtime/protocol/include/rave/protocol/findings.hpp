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

/// No host knows more of its robots than this, in bytes.
inline constexpr std::uint64_t kMostFindings =
    std::uint64_t{rave_wire_kMaxFindingsPart} * rave_wire_kMaxFindingsParts;

/// How long a host waits until a manager has them, once it has written its own files. A manager
/// waits for hosts that are still there for 20 s from the end of the run on.
inline constexpr Duration kFindingsPatience{10'000'000'000};

/// What one process knows of its run when that is over: bytes for the results of the whole.
struct Findings {
  std::uint64_t writer = 0;
  std::uint32_t host = 0;  ///< Its number in the scenario.
  std::vector<std::byte> bytes;
};

/// A host's end of the topic rave/findings. Must be gone before its bus; thread: that of the bus.
class FindingsSender {
 public:
  /// Errors: those of bus::Writer::create().
  [[nodiscard]] static Result<FindingsSender> create(bus::Bus& bus);

  /// Sends what this process knows, and waits until all managers that are there have got it, but
  /// not for longer than `patience`. Once. Errors: kInvalidArgument (nothing, or more than
  /// kMostFindings), kTimeout (who listens does not keep up), kState
  /// (nobody listens, or whoever did is gone).
  [[nodiscard]] Status send(std::uint32_t host, std::span<const std::byte> bytes,
                            Duration patience);
  /// How many managers are known to listen.
  [[nodiscard]] std::size_t readers() const { return writer_.readers(); }

 private:
  explicit FindingsSender(bus::Writer<bus::FindingsPart> writer) : writer_(std::move(writer)) {}

  bus::Writer<bus::FindingsPart> writer_;
};

/// Puts parts together again. Knows nothing of the bus.
class FindingsParts {
 public:
  /// Takes in a part that has passed validate(); twice is once, and behind the last is nothing.
  /// Errors: kInvalidArgument (it contradicts an earlier one of the same process), kParse (all are
  /// there and are not what was sent; what that process sends is dropped from then on).
  [[nodiscard]] Status add(const bus::FindingsPart& part);
  /// Whether all parts of a process have come and are right, or never will be.
  [[nodiscard]] bool done_with(std::uint64_t writer) const { return done_.contains(writer); }
  /// What is whole, in the order in which it became so; each once.
  [[nodiscard]] std::vector<Findings> hand_out();

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
  std::vector<Findings> whole_;
};

/// A manager's end. Must be gone before its bus; thread: that of the bus.
class FindingsCollector {
 public:
  /// Errors: those of bus::Reader::create().
  [[nodiscard]] static Result<FindingsCollector> create(bus::Bus& bus);
  [[nodiscard]] Status wake(bus::WaitSet& waits) { return waits.add(reader_); }

  /// Takes in what has come; parts of a process of which `sat(writer, host)` does not say that it
  /// had the place of this host are refused.
  void take(const std::function<bool(std::uint64_t, std::uint32_t)>& sat);
  [[nodiscard]] bool done_with(std::uint64_t writer) const { return parts_.done_with(writer); }
  [[nodiscard]] std::vector<Findings> hand_out() { return parts_.hand_out(); }

 private:
  explicit FindingsCollector(bus::Reader<bus::FindingsPart> reader) : reader_(std::move(reader)) {}

  bus::Reader<bus::FindingsPart> reader_;
  FindingsParts parts_;
};

}  // namespace rave::lock_step
