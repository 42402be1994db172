// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "rave/robot/hardware_sensor.hpp"
#include "utias/plugins/playback.hpp"
#include "utias/plugins/report_json.hpp"
#include "utias/plugins/timeline.hpp"

namespace rave::utias {

/// Plays one stream of a recording as its hardware delivered it: from a thread of its own, with
/// the original stamps. Opened again it starts over and gives the same samples.
///
/// `Stream` says what is special: types and constants `Record`, `kReading`, `kKind`, `kCapacity`,
/// `kCollect`; `code_meaning(params)`; and `timeline(params, playback)`, a Timeline<Record>.
///
/// Belongs to the thread of the host; only play() runs on the player's own, and reads what
/// configure() left.
template <class Stream>
class Player final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = Stream::kReading;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY_ASSIGN(Playback playback,
                    load_playback(setup, Stream::kKind, Stream::code_meaning(params)));
    timeline_ = Stream::timeline(params, playback);
    report_ = report_json(playback);
    live_ = playback.live;
    configured_ = true;
    declaration.capacity = std::max(Stream::kCapacity, timeline_.largest_group());
    declaration.collect = Stream::kCollect;
    declaration.clock = live_ ? DriverClock::kLive : DriverClock::kStepped;
    return {};
  }

  Status open(SampleSink& sink) override {
    if (!configured_) return fail(ErrorCode::kState, "opened before it was configured");
    if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
    try {
      thread_ = std::jthread([this, &sink](const std::stop_token& stop) { play(sink, stop); });
    } catch (const std::system_error& e) {
      return fail(ErrorCode::kIo, "cannot start the thread of the player: {}", e.what());
    }
    return {};
  }

  void close() override {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

  [[nodiscard]] std::string report() const override { return report_; }

 private:
  void play(SampleSink& sink, const std::stop_token& stop) const noexcept {
    for (const auto& group : timeline_.groups) {
      if (stop.stop_requested()) return;
      if (live_) {
        if (!sink.wait_until(group.stamp)) return;
      } else {
        // All of the time before the next stamp, not only up to the last one: publish() may have
        // to wait for room, and the host could be waiting for a moment in between.
        sink.complete_up_to({group.stamp.ns - 1});
      }
      if (!sink.publish(group.stamp, &timeline_.records[group.first], group.count)) return;
    }
    sink.complete_up_to({std::numeric_limits<std::int64_t>::max()});
  }

  Timeline<typename Stream::Record> timeline_;
  std::string report_ = "{}";
  bool live_ = false;
  bool configured_ = false;
  std::jthread thread_;  // last: it ends before what it reads is gone
};

}  // namespace rave::utias
