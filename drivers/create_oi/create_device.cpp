// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_device.hpp"

#include <algorithm>

#include "rave/base/thread.hpp"
#include "rave/line/backoff.hpp"

namespace rave::oi {
// One thread talks to the robot: it connects, reads frames and sends drive commands. Drivers of the
// robot's sensors are called from it with each frame. The thread of the actuator only leaves an
// order (`order_mutex_`) and rings the bell, so a slow line never holds up a step.
namespace {

using line::HostTime;
using line::ReadEnd;
using line::Wait;

constexpr Wait kConnect{1000};
/// After this time without a valid frame the session is restarted.
constexpr double kSilence_s = 0.5;
/// Time between two attempts to leave passive mode.
constexpr double kModePause_s = 0.5;
/// The clock drift is reported after this much measuring.
constexpr double kDriftAfter_s = 5;

/// Packets that are always requested: the mode, and the causes for leaving safe mode.
constexpr std::array kAlways{Packet::kBumpsAndDrops,   Packet::kCliffLeft,  Packet::kCliffFrontLeft,
                             Packet::kCliffFrontRight, Packet::kCliffRight, Packet::kMode};

std::string reason(const OiState& robot) {
  if (robot.any_drop()) return "a wheel has dropped";
  if (robot.any_cliff()) return "a cliff sensor is active";
  if (robot.charging_state != 0) return "it is charging";
  return "the reason is unknown; a button, the charger, or an earlier cliff";
}

}  // namespace

Status CreateDevice::configure(const HardwareDeviceSetup& setup) {
  RAVE_TRY_ASSIGN(options_, read_options(setup.parameters()));
  RAVE_TRY(wake_.open());
  host_ = setup.host;
  packets_.clear();
  want(kAlways);
  configured_ = true;
  return {};
}

void CreateDevice::want(std::span<const Packet> packets) {
  for (const Packet packet : packets) {
    const auto id = static_cast<std::uint8_t>(packet);
    // Several sensors may need the same packet, and a packet requested twice would be in each frame
    // twice.
    if (std::find(packets_.begin(), packets_.end(), id) == packets_.end()) packets_.push_back(id);
  }
}

void CreateDevice::log(LogLevel level, const std::string& text) const { host_.write(level, text); }

Status CreateDevice::open() {
  if (!configured_) return fail(ErrorCode::kState, "opened before it was configured");
  if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
  // Ten bits per byte: 8N1 has a start and a stop bit. The robot sends a frame each 15 ms whether
  // or not the last one is out; a longer one would be garbled without end.
  const double frame_s = static_cast<double>(StreamDecoder(packets_).frame_size()) * 10 /
                         static_cast<double>(options_.address.baud);
  if (options_.address.is_serial() && frame_s > kStreamPeriod_s) {
    return fail(
        ErrorCode::kInvalidArgument,
        "{} baud carry a frame of these sensors in {:.1f} ms, but one comes each {:.0f} ms: "
        "use a higher `baud` or fewer sensors",
        options_.address.baud, frame_s * 1e3, kStreamPeriod_s * 1e3);
  }
  wake_.clear();
  lost_ = false;
  forget_order();
  note([](DeviceState& state) { state = {}; });
  RAVE_TRY(start_thread(thread_, "the robot", [this](const std::stop_token& stop) { run(stop); }));
  std::unique_lock lock(state_mutex_);
  if (state_changed_.wait_for(lock, std::chrono::duration<double>(options_.timing.start_timeout_s),
                              [&] { return state_.frames > 0; })) {
    return {};
  }
  const std::string trouble = state_.trouble.empty() ? "nothing came" : state_.trouble;
  lock.unlock();
  close();
  return fail(ErrorCode::kTimeout,
              "no robot with the Open Interface answered at `{}` within {} s: "
              "{}",
              options_.address.text(), options_.timing.start_timeout_s, trouble);
}

void CreateDevice::close() { wake_.end(thread_); }

std::string CreateDevice::report() const {
  if (!configured_) return "{}";
  const std::lock_guard lock(state_mutex_);
  return report_json(options_.address.text(), state_);
}

void CreateDevice::attach(FrameListener& listener) {
  const std::lock_guard lock(listeners_mutex_);
  listeners_.push_back(&listener);
  // A sensor that is opened while the robot is away would otherwise wait for a failure that was
  // reported already.
  if (lost_) listener.gone(name() + " is away");
}

void CreateDevice::detach(FrameListener& listener) {
  const std::lock_guard lock(listeners_mutex_);
  std::erase(listeners_, &listener);
}

Status CreateDevice::drive(WheelSpeeds speeds, double keep_s) {
  {
    const std::lock_guard lock(order_mutex_);
    order_ = {speeds, line::after_seconds(line::host_now(), keep_s), true};
  }
  // Only while a session runs. Otherwise the bell would interrupt an attempt to connect.
  if (ringing_) wake_.ring();
  if (lost_)
    return fail(ErrorCode::kIo, "{} is disconnected; its wheels cannot be commanded", name());
  return {};
}

/// A robot that reconnects must not continue an old order.
void CreateDevice::forget_order() {
  const std::lock_guard lock(order_mutex_);
  order_ = {};
}

void CreateDevice::run(const std::stop_token& stop) {
  line::Backoff backoff;
  last_frame_ = line::host_now();
  while (!stop.stop_requested()) {
    const HostTime before = last_frame_;
    const Status ended = talk_until_lost(stop);
    ringing_ = false;
    forget_order();
    note([](DeviceState& state) { state.connected = false; });
    if (stop.stop_requested() || ended) return;
    note([&](DeviceState& state) { state.trouble = ended.error().message; });
    // Only a session that had frames resets the waits. A device that accepts and stays silent is
    // tried less and less often.
    if (last_frame_ != before) {
      backoff.reset();
      log(LogLevel::kWarning, name() + " was lost: " + ended.error().message);
    }
    lost(ended.error());
    if (!pause(backoff.next(), stop)) return;
  }
}

/// Returns false if the thread must end.
bool CreateDevice::pause(Wait wait, const std::stop_token& stop) {
  const HostTime end = line::host_now() + wait;
  while (line::host_now() < end) {
    if (wake_.wait(line::until(end))) wake_.clear();
    if (stop.stop_requested()) return false;
  }
  return true;
}

void CreateDevice::lost(const Error& why) {
  if (lost_ || line::host_now() < line::after_seconds(last_frame_, options_.timing.lost_after_s)) {
    return;
  }
  const std::string text = fmt::format("{} has been disconnected for more than {} s: {}", name(),
                                       options_.timing.lost_after_s, why.message);
  const std::lock_guard lock(listeners_mutex_);
  lost_ = true;
  for (FrameListener* const listener : listeners_) listener->gone(text);
}

void CreateDevice::found() {
  log(LogLevel::kInfo, name() + " is back");
  const std::lock_guard lock(listeners_mutex_);
  lost_ = false;
  for (FrameListener* const listener : listeners_) listener->back();
}

Status CreateDevice::talk_until_lost(const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(line::ByteLine opened, line::ByteLine::open(options_.address, kConnect, &wake_));
  OiSession session(std::move(opened), &wake_, packets_);
  RAVE_TRY(session.begin(options_.mode));
  Status ended = converse(session, stop);
  session.end();
  return ended;
}

/// Returns success when the host closes.
Status CreateDevice::converse(OiSession& session, const std::stop_token& stop) {
  const HostTime began = line::host_now();
  HostTime good = began;
  bool heard = false;
  counted_ = {};
  note([&](const DeviceState& state) { missing_before_ = state.missing_frames; });
  told_ = {};
  order_kept_ = false;
  drive_at_ = began;
  last_mode_ = Mode::kOff;
  while (true) {
    if (stop.stop_requested()) return {};
    HostTime limit = line::after_seconds(good, kSilence_s);
    if (heard) {
      RAVE_TRY(keep_mode(session));
      RAVE_TRY(keep_driving(session));
      limit = std::min(limit, drive_at_);
    }
    const auto next = session.next(limit);
    note_counts(session);
    if (next.end == ReadEnd::kWoken) wake_.clear();
    if (next.end == ReadEnd::kLost) return fail(ErrorCode::kIo, "{}", session.lost());
    if (next.end == ReadEnd::kBytes) {
      good = line::host_now();
      if (!heard) {
        note([](DeviceState& state) {
          state.connected = true;
          ++state.connects;
        });
        // The first frames may still show the mode from before the start commands.
        mode_at_ = line::after_seconds(good, kModePause_s);
        ringing_ = true;
      }
      heard = true;
      take(*next.frame, session);
    } else if (line::host_now() >= line::after_seconds(good, kSilence_s)) {
      return fail(ErrorCode::kTimeout, "no valid frame for {:.1f} s", kSilence_s);
    }
  }
}

void CreateDevice::take(const Frame& frame, OiSession& session) {
  OiState state = robot_;
  // The checksum misses one in 256 garbled frames; an impossible mode reveals some of them.
  if (!read_packets(frame.body, state) || state.mode > Mode::kFull) {
    note([](DeviceState& counts) { ++counts.bad_layout; });
    return;
  }
  robot_ = state;
  last_frame_ = line::host_now();
  const double moment_s = session.times().next(frame.began_s) - options_.timing.latency_s;
  if (lost_) found();
  {
    const std::lock_guard lock(listeners_mutex_);
    for (FrameListener* const listener : listeners_) listener->take(robot_, moment_s);
  }
  const double period_s = session.times().measured_period_s();
  note([&](DeviceState& counts) {
    ++counts.frames;
    counts.robot = robot_;
    counts.period_ms = period_s * 1e3;
    if (session.times().known_for_s() > kDriftAfter_s) {
      counts.clock_drift_ppm = (kStreamPeriod_s / period_s - 1) * 1e6;
    }
    counts.missing_frames = missing_before_ + session.times().missing();
  });
  state_changed_.notify_all();
}

void CreateDevice::note_counts(const OiSession& session) {
  const StreamDecoder::Counts& counts = session.counts();
  note([&](DeviceState& state) {
    state.bad_checksum += counts.bad_checksum - counted_.bad_checksum;
    state.bad_layout += counts.bad_layout - counted_.bad_layout;
    state.skipped_bytes += counts.skipped - counted_.skipped;
  });
  counted_ = counts;
}

/// Sends a new order, repeats it in time, and stops the wheels when it expires.
Status CreateDevice::keep_driving(OiSession& session) {
  Order order;
  {
    const std::lock_guard lock(order_mutex_);
    order = order_;
  }
  const HostTime now = line::host_now();
  if (!order.given) {
    drive_at_ = line::after_seconds(now, options_.refresh_s);
    return {};
  }
  const bool in_force = now < order.until;
  const WheelSpeeds speeds = in_force ? order.speeds : WheelSpeeds{};
  // Counted and logged once, when the order expires, and not for an order to stand.
  if (order_kept_ && !in_force && order.speeds != WheelSpeeds{}) {
    note([](DeviceState& state) { ++state.watchdog_stops; });
    log(LogLevel::kWarning, name() + " received no command for too long; its wheels are stopped");
  }
  order_kept_ = in_force;
  if (speeds != told_ || now >= drive_at_) {
    RAVE_TRY(session.send(drive_direct_command(speeds.left_mmps, speeds.right_mmps)));
    told_ = speeds;
    drive_at_ = line::after_seconds(now, options_.refresh_s);
    note([](DeviceState& state) { ++state.drive_commands; });
  }
  // The loop must wake when the order expires, even if the next repetition is later.
  if (in_force) drive_at_ = std::min(drive_at_, order.until);
  return {};
}

/// Reports that the robot left its mode, and restores the mode. It does not while a wheel has
/// dropped; and at a cliff only for an order to drive away, because otherwise the robot would creep
/// over the edge.
Status CreateDevice::keep_mode(OiSession& session) {
  const HostTime now = line::host_now();
  const bool was_good = last_mode_ == options_.mode;
  last_mode_ = robot_.mode;
  if (robot_.mode == options_.mode) {
    if (!was_good)
      log(LogLevel::kInfo, fmt::format("{} is in {} mode", name(), to_string(robot_.mode)));
    return {};
  }
  if (was_good) {
    note([](DeviceState& state) { ++state.mode_losses; });
    log(LogLevel::kWarning,
        fmt::format("{} went from {} to {} mode and does not obey: {}", name(),
                    to_string(options_.mode), to_string(robot_.mode), reason(robot_)));
    mode_at_ = now;
  }
  if (now < mode_at_ || robot_.any_drop()) return {};
  if (robot_.any_cliff()) {
    const std::lock_guard lock(order_mutex_);
    if (order_.speeds.left_mmps + order_.speeds.right_mmps > 0) return {};
  }
  mode_at_ = line::after_seconds(now, kModePause_s);
  // The present order is sent again behind the change of mode.
  drive_at_ = now;
  return session.send(start_command() + mode_command(options_.mode));
}

}  // namespace rave::oi
