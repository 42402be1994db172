// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "rave/base/thread.hpp"
#include "rave/line/backoff.hpp"
#include "rave/line/clock_offset.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "scip_laser/laser_options.hpp"
#include "scip_laser/laser_report.hpp"
#include "scip_laser/scip_code.hpp"
#include "scip_laser/scip_session.hpp"

namespace rave::scip {
namespace {

using line::HostTime;
using line::ReadEnd;
using line::Wait;

/// A device without a valid scan for this many periods, and at least for kSilence_s, is
/// reconnected.
constexpr double kSilentPeriods = 5;
constexpr double kSilence_s = 0.5;
constexpr Wait kConnect{1000};
constexpr std::string_view kAnew =
    "the clock of the laser was set forward; how late its scans are is not known";

/// A SCIP 2.0 laser. The host's thread calls configure(), open(), close() and report(); the
/// driver's thread runs run() and what it calls. They share `state_`, under its mutex.
class ScipLaser final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override;
  Status open(SampleSink& sink) override;
  void close() override;
  [[nodiscard]] std::string report() const override;

 private:
  /// The state of an uninterrupted series of scans.
  struct Stretch {
    line::ClockOffset clock;
    UnwrappedTime timer;
    double last_device_s = -1;
    double first_device_s = -1;
    std::uint64_t scans = 0;

    /// After a scan that does not count.
    void restore_timer() {
      (void)timer.seconds(static_cast<std::uint32_t>(
          static_cast<std::uint64_t>(std::llround(last_device_s * 1e3)) & 0xffffffU));
    }
  };

  [[nodiscard]] Result<Identity> find_device();
  /// Time between two scans.
  [[nodiscard]] double period_s() const {
    return identity_.parameters.scan_period_s() * (1 + request_.skipped_scans);
  }
  void run(SampleSink& sink, const std::stop_token& stop);
  [[nodiscard]] Status scan_until_lost(SampleSink& sink, HostTime& last_scan);
  [[nodiscard]] Status stream(ScipSession& session, SampleSink& sink, HostTime& last_scan);
  /// Returns true for a valid scan.
  [[nodiscard]] bool take(const ScipSession::Next& next, Stretch& stretch, SampleSink& sink);
  void report_loss(SampleSink& sink, HostTime last_scan, const Error& why);
  template <class Change>
  void note(Change change) {
    const std::lock_guard lock(mutex_);
    change(state_);
  }

  LaserOptions options_;
  Identity identity_;
  ScanRequest request_;
  std::vector<double> bearings_rad_;
  bool configured_ = false;
  line::Wake wake_;

  Scan scan_;                       // of the driver's thread
  std::int64_t last_stamp_ns_ = 0;  // of the driver's thread
  bool loss_reported_ = false;      // of the driver's thread

  mutable std::mutex mutex_;  // guards state_
  LaserState state_;
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

Result<Identity> ScipLaser::find_device() {
  const HostTime end = line::after_seconds(line::host_now(), options_.timing.start_timeout_s);
  line::Backoff backoff;
  while (true) {
    auto found = [&]() -> Result<Identity> {
      RAVE_TRY_ASSIGN(line::ByteLine opened,
                      line::ByteLine::open(options_.address, kConnect, nullptr));
      return ScipSession(std::move(opened), nullptr).identify();
    }();
    if (found) return found;
    if (line::host_now() >= end) {
      return fail(ErrorCode::kTimeout, "no SCIP 2.0 device answered at `{}` within {} s: {}",
                  options_.address.text(), options_.timing.start_timeout_s, found.error().message);
    }
    (void)wake_.wait(std::min(backoff.next(), line::until(end)));
  }
}

Status ScipLaser::configure(const HardwareSetup& setup, HardwareDeclaration& declaration) {
  RAVE_TRY_ASSIGN(options_, read_options(setup.parameters()));
  RAVE_TRY(wake_.open());
  // The device is asked now, because rays and ranges must be declared before the run begins.
  RAVE_TRY_ASSIGN(identity_, find_device());
  RAVE_TRY_ASSIGN(request_, request_for(options_, identity_.parameters));
  bearings_rad_.clear();
  for (std::int32_t step = request_.first_step; step <= request_.last_step; ++step) {
    bearings_rad_.push_back(identity_.parameters.bearing_rad(step));
  }
  declaration.capacity = request_.size();
  declaration.clock = DriverClock::kLive;
  declaration.range_min_m = request_.range_min_mm * 1e-3;
  declaration.range_max_m = request_.range_max_mm * 1e-3;
  declaration.bearings_rad = bearings_rad_.data();
  declaration.period_s = period_s();
  configured_ = true;
  return {};
}

Status ScipLaser::open(SampleSink& sink) {
  if (!configured_) return fail(ErrorCode::kState, "opened before it was configured");
  if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
  wake_.clear();
  last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
  loss_reported_ = false;
  note([](LaserState& state) { state = {}; });
  return start_thread(thread_, "the laser",
                      [this, &sink](const std::stop_token& stop) { run(sink, stop); });
}

void ScipLaser::close() { wake_.end(thread_); }

std::string ScipLaser::report() const {
  if (!configured_) return "{}";
  const std::lock_guard lock(mutex_);
  return report_json(options_.address.text(), identity_, request_, state_);
}

void ScipLaser::run(SampleSink& sink, const std::stop_token& stop) {
  line::Backoff backoff;
  HostTime last_scan = line::host_now();
  while (!stop.stop_requested()) {
    const HostTime before = last_scan;
    const Status ended = scan_until_lost(sink, last_scan);
    note([](LaserState& state) { state.connected = false; });
    if (stop.stop_requested() || ended) return;
    note([&](LaserState& state) { state.trouble = ended.error().message; });
    if (last_scan != before) backoff.reset();
    report_loss(sink, last_scan, ended.error());
    if (wake_.wait(backoff.next())) return;
  }
}

void ScipLaser::report_loss(SampleSink& sink, HostTime last_scan, const Error& why) {
  if (loss_reported_ ||
      line::host_now() < line::after_seconds(last_scan, options_.timing.lost_after_s)) {
    return;
  }
  loss_reported_ = true;
  const std::string text =
      fmt::format("the laser at `{}` has been disconnected for more than {} s: {}",
                  options_.address.text(), options_.timing.lost_after_s, why.message);
  sink.fail(text.data(), text.size());
}

Status ScipLaser::scan_until_lost(SampleSink& sink, HostTime& last_scan) {
  RAVE_TRY_ASSIGN(line::ByteLine opened, line::ByteLine::open(options_.address, kConnect, &wake_));
  ScipSession session(std::move(opened), &wake_);
  RAVE_TRY_ASSIGN(const Identity identity, session.identify());
  // The program was told bearings and ranges once. Another device behind the same port would be
  // read wrongly.
  if (!(identity.parameters == identity_.parameters)) {
    return fail(ErrorCode::kState, "the device has changed: `{}` instead of `{}`",
                identity.parameters.model, identity_.parameters.model);
  }
  RAVE_TRY(session.begin(request_));
  Status ended = stream(session, sink, last_scan);
  session.end();
  return ended;
}

/// Returns success when the sink or the host closes.
Status ScipLaser::stream(ScipSession& session, SampleSink& sink, HostTime& last_scan) {
  const double silence_s = std::max(kSilence_s, kSilentPeriods * period_s());
  Stretch stretch;
  ScipDecoder::Counts counted;
  HostTime good = line::host_now();
  HostTime ask_at = good;
  note([](LaserState& state) {
    state.connected = true;
    ++state.connects;
  });
  while (true) {
    if (!request_.continuous && line::host_now() >= ask_at) {
      RAVE_TRY(session.poll(request_));
      // The device has a new scan only after its period; asking sooner would repeat the last one.
      ask_at = line::after_seconds(line::host_now(), period_s());
    }
    const HostTime silent_at = line::after_seconds(good, silence_s);
    const auto next = session.next(request_.continuous ? silent_at : std::min(ask_at, silent_at));
    const ScipDecoder::Counts& counts = session.counts();
    note([&](LaserState& state) {
      state.bad_checksum += counts.bad_checksum - counted.bad_checksum;
      state.malformed += counts.malformed - counted.malformed;
    });
    counted = counts;
    if (next.end == ReadEnd::kWoken) return {};
    if (next.end == ReadEnd::kLost) return fail(ErrorCode::kIo, "{}", session.lost());
    if (next.end == ReadEnd::kBytes && take(next, stretch, sink)) {
      good = line::host_now();
      last_scan = good;
      if (loss_reported_) sink.recover();
      loss_reported_ = false;
    } else if (line::host_now() >= silent_at) {
      return fail(ErrorCode::kTimeout, "no valid scan for {:.1f} s", silence_s);
    }
  }
}

bool ScipLaser::take(const ScipSession::Next& next, Stretch& stretch, SampleSink& sink) {
  const ScanEnd end = read_scan(*next.reply, request_, scan_);
  if (end == ScanEnd::kMalformed) note([](LaserState& state) { ++state.malformed; });
  if (end == ScanEnd::kRefused) {
    note([&](LaserState& state) {
      ++state.refused;
      state.trouble = describe_status(next.reply->status);
    });
  }
  if (end != ScanEnd::kScan) return false;
  const double device_s = stretch.timer.seconds(scan_.timer_ms);
  if (device_s <= stretch.last_device_s) {
    // A duplicate, or an older scan that was delayed.
    stretch.restore_timer();
    note([](LaserState& state) { ++state.repeated; });
    return false;
  }
  // Arrivals jitter by the line and the operating system; the device's timer does not. The estimate
  // puts the timer on the host's clock.
  const auto sample = stretch.clock.add(device_s, line::host_seconds(next.arrived));
  if (sample == line::ClockOffset::Sample::kEarly) {
    stretch.restore_timer();
    note([](LaserState& state) { ++state.early; });
    return false;
  }
  if (sample == line::ClockOffset::Sample::kSet) sink.begin_anew(kAnew.data(), kAnew.size());
  if (stretch.scans++ == 0) stretch.first_device_s = device_s;
  stretch.last_device_s = device_s;
  const double host_s = device_s + stretch.clock.offset_s(device_s) - options_.timing.latency_s;
  const SimTime stamp = line::run_stamp(sink, host_s);
  // A better estimate may move the clock back by less than a scan. A sensor's stamps must increase.
  const bool in_order = stamp.ns > last_stamp_ns_;
  // Without any measured ray it is no sample, so that the sensor grows old and its robot stands.
  // The line is alive: the device is not started again for it.
  const bool sees = scan_.sees();
  if (in_order && sees) {
    last_stamp_ns_ = stamp.ns;
    (void)sink.publish(stamp, scan_.ranges_m.data(), request_.size());
  }
  note([&](LaserState& state) {
    ++(!sees ? state.blind : in_order ? state.scans : state.held_back);
    state.clock_offset_s = stretch.clock.offset_s();
    state.clock_drift_ppm = stretch.clock.drift_ppm();
    state.clock_restarts = stretch.clock.restarts();
    if (stretch.scans > 1) {
      state.rate_hz = static_cast<double>(stretch.scans - 1) / (device_s - stretch.first_device_s);
    }
  });
  return true;
}

}  // namespace
}  // namespace rave::scip

RAVE_PLUGIN("scip_laser") {
  rave::add_sensor<rave::scip::ScipLaser>(
      registry, {.name = "scip_laser",
                 .summary = "Reads a SCIP 2.0 laser scanner, such as those of Hokuyo.",
                 .params = rave::scip::kLaserParams,
                 .clock = rave::DriverClock::kLive,
                 .timing = rave::SampleTiming::kPeriodic});
}
