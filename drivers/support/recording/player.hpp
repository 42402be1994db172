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

/// The data of a stream for its player.
template <class Record>
struct Played {
  Timeline<Record> timeline;
  std::string report = "{}";  ///< JSON.
  bool live = false;
};

/// Plays one stream of a recording like its hardware: from its own thread, with the original
/// stamps. Each open() starts over with the same samples.
///
/// `Stream` defines the specifics: types and constants `Record`, `kReading`, `kCapacity` (least
/// number of records to make room for), `kCollect`; `load(setup)`, which returns a
/// Result<Played<Record>>; and `declare(declaration)`, which may add to the declaration and refer
/// to the stream.
///
/// Belongs to the thread of the host; only play() runs in the player's thread, and reads data of
/// configure().
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
        if (!sink.wait_until(group.delivered)) return;
      } else {
        // Completes only the time before the next stamp: publish() may wait for room while the host
        // waits for completeness.
        sink.complete_up_to({group.stamp.ns - 1});
      }
      const auto* records = played_.timeline.records.data() + group.first;
      if (!sink.publish(group.stamp, records, group.count)) return;
    }
    sink.complete_up_to({std::numeric_limits<std::int64_t>::max()});
  }

  Stream stream_;
  Played<typename Stream::Record> played_;
  bool configured_ = false;
  std::jthread thread_;  // last member: it ends before the data it reads is destroyed
};

}  // namespace rave::recording
