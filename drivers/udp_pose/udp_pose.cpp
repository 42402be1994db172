// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>

#include "pose_doubt/pose_doubt.hpp"
#include "rave/base/thread.hpp"
#include "rave/line/datagram_socket.hpp"
#include "rave/line/timing.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "udp_pose/pose_stream.hpp"

namespace rave::udp_pose {
namespace {

constexpr std::array<ParamSpec, 8> kParams{
    required(
        text_param("body", "", "Name of the body in the datagrams; other bodies are ignored.")),
    required(integer_param("port", 0, 0, 65535, "UDP port to listen on; 0: a free one.")),
    text_param("listen", "127.0.0.1",
               "Numeric address to listen on; 0.0.0.0 accepts datagrams from other machines."),
    pose_doubt::position_sigma(0.001,
                               "Standard deviation of x and y where a datagram has no `cov`."),
    pose_doubt::heading_sigma(0.5,
                              "Standard deviation of the heading where a datagram has no `cov`."),
    number_param("max_delay_s", "s", 0.2, 0.001, 60,
                 "Largest delay beyond the smallest; later samples are dropped."),
    line::latency_param("Smallest delay from a pose to its arrival.", 10),
    line::lost_after_param(2, "Time after which a silent stream is reported as lost."),
};

constexpr std::string_view kAnew =
    "the clock of the sender was set, or it began anew; how late its poses are is not known";

/// Receives poses from another program. The host's thread calls configure(), open(), close() and
/// report(); the driver's thread runs run(). They share `state_`, under its mutex.
class UdpPose final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override;
  Status open(SampleSink& sink) override;
  void close() override;
  [[nodiscard]] std::string report() const override;

 private:
  void run(SampleSink& sink, const std::stop_token& stop);
  /// False: dropped, because the stamp would decrease.
  [[nodiscard]] bool publish(const PoseDatagram& datagram, double host_s, SampleSink& sink);
  void report_silence(SampleSink& sink) const;

  HostServices host_;
  std::string body_;
  std::string listen_;
  pose_doubt::Doubt doubt_;
  double max_delay_s_ = 0;
  double latency_s_ = 0;
  double lost_after_s_ = 0;
  std::optional<line::DatagramSocket> socket_;
  line::Wake wake_;
  std::int64_t last_stamp_ns_ = 0;  // of the driver's thread

  mutable std::mutex mutex_;  // guards state_
  StreamState state_;
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

Status UdpPose::configure(const HardwareSetup& setup, HardwareDeclaration& declaration) {
  const Params params = setup.parameters();
  host_ = setup.host;
  body_ = params.text("body");
  if (body_.empty()) return fail(ErrorCode::kInvalidArgument, "`body` is empty");
  listen_ = params.text("listen");
  doubt_ = pose_doubt::read_doubt(params);
  max_delay_s_ = params.number("max_delay_s");
  latency_s_ = params.number("latency_s");
  lost_after_s_ = params.number("lost_after_s");
  RAVE_TRY(wake_.open());
  // Bound here instead of in open(), so that a port in use is an error at the start, and the port
  // stays the same.
  const auto port = static_cast<std::uint16_t>(params.integer("port"));
  RAVE_TRY_ASSIGN(socket_, line::DatagramSocket::open(listen_, port, nullptr));
  declaration.capacity = 1;
  declaration.clock = DriverClock::kLive;
  return {};
}

Status UdpPose::open(SampleSink& sink) {
  if (!socket_) return fail(ErrorCode::kState, "opened before it was configured");
  if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
  wake_.clear();
  last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
  {
    const std::lock_guard lock(mutex_);
    state_ = {};
  }
  return start_thread(thread_, "the pose stream",
                      [this, &sink](const std::stop_token& stop) { run(sink, stop); });
}

void UdpPose::close() { wake_.end(thread_); }

void UdpPose::run(SampleSink& sink, const std::stop_token& stop) {
  PoseStream stream(body_, max_delay_s_, lost_after_s_);
  line::Peer sender;
  PoseDatagram datagram;
  std::array<char, kMaxDatagram + 1> text{};  // one byte more, to detect longer datagrams
  const auto room = std::as_writable_bytes(std::span(text));
  std::uint64_t held_back = 0;
  bool silence_reported = false;
  line::HostTime silent_at = line::after_seconds(line::host_now(), lost_after_s_);
  // Datagrams that waited since configure() are old, and their arrival says nothing about the
  // clock.
  while (socket_->receive(room, line::Wait(0), wake_).end == line::ReadEnd::kBytes) {
  }
  while (!stop.stop_requested()) {
    const auto wait = silence_reported ? line::Wait(60'000) : line::until(silent_at);
    const auto got = socket_->receive(room, wait, wake_, &sender);
    if (got.end == line::ReadEnd::kWoken) return;
    if (got.end == line::ReadEnd::kBytes) {
      const double now_s = line::host_seconds(line::host_now());
      const auto taken = stream.take({text.data(), got.size}, sender.text, now_s, datagram);
      if (!taken.news.empty()) host_.write(LogLevel::kWarning, taken.news);
      if (taken.anew) sink.begin_anew(kAnew.data(), kAnew.size());
      if (taken.verdict == PoseStream::Verdict::kAccepted) {
        if (!publish(datagram, taken.host_s, sink)) ++held_back;
        silent_at = line::after_seconds(line::host_now(), lost_after_s_);
        if (silence_reported) sink.recover();
        silence_reported = false;
      }
      const std::lock_guard lock(mutex_);
      state_ = stream.state();
      state_.held_back = held_back;
    }
    if (!silence_reported && line::host_now() >= silent_at) {
      silence_reported = true;
      report_silence(sink);
    }
  }
}

bool UdpPose::publish(const PoseDatagram& datagram, double host_s, SampleSink& sink) {
  const SimTime stamp = line::run_stamp(sink, host_s - latency_s_);
  if (stamp.ns <= last_stamp_ns_) return false;
  last_stamp_ns_ = stamp.ns;
  PoseReading pose{datagram.x_m, datagram.y_m, datagram.yaw_rad, doubt_.variance_xy_m2,
                   doubt_.variance_yaw_rad2};
  if (datagram.variance) {
    // One number represents both axes: the larger one, which does not understate the uncertainty.
    pose.variance_xy_m2 = std::max(datagram.variance->x_m2, datagram.variance->y_m2);
    pose.variance_yaw_rad2 = datagram.variance->yaw_rad2;
  }
  (void)sink.publish(stamp, &pose, 1);
  return true;
}

void UdpPose::report_silence(SampleSink& sink) const {
  const std::string text =
      fmt::format("no pose of `{}` on UDP port {} for {} s", body_, socket_->port(), lost_after_s_);
  sink.fail(text.data(), text.size());
}

std::string UdpPose::report() const {
  if (!socket_) return "{}";
  const std::lock_guard lock(mutex_);
  nlohmann::ordered_json json;
  json["listen"] = listen_;
  json["port"] = socket_->port();
  json["body"] = body_;
  json["samples"] = state_.samples;
  json["rate_hz"] = state_.rate_hz;
  json["lost"] = state_.lost;
  json["duplicates"] = state_.duplicates;
  json["out_of_order"] = state_.out_of_order;
  json["late"] = state_.late;
  json["early"] = state_.early;
  json["held_back"] = state_.held_back;
  json["refused"] = state_.refused;
  json["other_bodies"] = state_.other_bodies;
  json["sender"] = state_.sender;
  json["other_senders"] = state_.other_senders;
  json["restarts"] = state_.restarts;
  json["mean_delay_s"] = state_.mean_delay_s;
  json["max_delay_s"] = state_.max_delay_s;
  json["clock_offset_s"] = state_.clock_offset_s;
  json["clock_drift_ppm"] = state_.clock_drift_ppm;
  json["trouble"] = state_.trouble;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace
}  // namespace rave::udp_pose

RAVE_PLUGIN("udp_pose") {
  rave::add_sensor<rave::udp_pose::UdpPose>(
      registry, {.name = "udp_pose",
                 .summary = "Receives poses in UDP datagrams, for example from motion capture.",
                 .params = rave::udp_pose::kParams,
                 .clock = rave::DriverClock::kLive});
}
