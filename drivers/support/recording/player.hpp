// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "recording/timeline.hpp"

namespace rave::recording {

/// What a stream hands to its player.
template <class Record>
struct Played {
  Timeline<Record> timeline;
  std::string report = "{}";  ///< JSON.
  bool live = false;
};

/// Plays one stream of a recording as its hardware delivered it: from a thread of its own, with
/// the original stamps. Opened again it starts over and gives the same samples.
///
/// `Stream` says what is special: types and constants `Record`, `kReading`, `kCapacity` (at least
/// so many records are made room for), `kCollect`; `load(setup)`, a Result<Played<Record>>; and
/// `declare(declaration)`, which may add to what is declared and what points into the stream.
///
/// Belongs to the thread of the host; only play() runs on the player's own, and reads what
/// configure() left.
template <class Stream>
class Player final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = Stream::kReading;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    RAVE_TRY_ASSIGN(played_, stream_.load(setup));
    configured_ = true;
    declaration.capacity = std::max(Stream::kCapacity, played_.timeline.largest_group());
    declaration.collect = Stream::kCollect;
    declaration.clock = played_.live ? DriverClock::kLive : DriverClock::kStepped;
    stream_.declare(declaration);
    return {};
  }

  Status open(SampleSink& sink) override {
    if (!configured_) return fail(ErrorCode::kState, "opened before it was configured");
    if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
    return start_thread(thread_, "the player",
                        [this, &sink](const std::stop_token& stop) { play(sink, stop); });
  }

  void close() override {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

  [[nodiscard]] std::string report() const override { return played_.report; }

 private:
  void play(SampleSink& sink, const std::stop_token& stop) const noexcept {
    for (const auto& group : played_.timeline.groups) {
      if (stop.stop_requested()) return;
      if (played_.live) {
        if (!sink.wait_until(group.stamp)) return;
      } else {
        // All of the time before the next stamp, not only up to the last one: publish() may have
        // to wait for room, and the host could be waiting for a moment in between.
        sink.complete_up_to({group.stamp.ns - 1});
      }
      const auto* records = &played_.timeline.records[group.first];
      if (!sink.publish(group.stamp, records, group.count)) return;
    }
    sink.complete_up_to({std::numeric_limits<std::int64_t>::max()});
  }

  Stream stream_;
  Played<typename Stream::Record> played_;
  bool configured_ = false;
  std::jthread thread_;  // last: it ends before what it reads is gone
};

}  // namespace rave::recording
