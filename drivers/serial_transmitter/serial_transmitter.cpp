// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "rave/base/thread.hpp"
#include "rave/line/backoff.hpp"
#include "rave/line/byte_line.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "serial_transmitter/serial_frame.hpp"

namespace rave::serial_transmitter {
namespace {

using line::HostTime;
using line::ReadEnd;
using line::Wait;

constexpr Wait kConnect{1000};
constexpr Wait kIdle{60'000};

constexpr ParamSpec kParams[] = {
    text_param("device", "", "Serial device, such as /dev/ttyUSB0. Or `address`."),
    integer_param("baud", 57600, 1, 4'000'000, "Bit rate of the serial line."),
    text_param("address", "", "host:port of a serial line behind TCP."),
    number_param("byte_rate", "B/s", 0, 0, 1e9,
                 "Byte rate of the radio behind the line; 0: that of the line, a tenth of `baud`."),
    integer_param("queue_bytes", 4096, 64, 100'000'000,
                  "Bytes of frames that may wait to be sent; further packets are lost."),
    integer_param("max_packet_bytes", 512, 64, 65535, "Longest packet, with its header."),
    text_param("network", "rave", "Name of the network; packets of other networks are ignored."),
};

/// Sends packets as frames on a serial line. The host's thread calls configure(), open(), send(),
/// close() and report(); the driver's thread runs run(). They share what `mutex_` guards.
class SerialTransmitter final : public Transmitter {
 public:
  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override;
  Status open(PacketSink& sink) override;
  Status send(std::span<const std::byte> packet) override;
  void close() override;
  [[nodiscard]] std::string report() const override;

 private:
  struct State {
    std::uint64_t sent = 0;
    std::uint64_t sent_bytes = 0;
    std::uint64_t queue_full = 0;
    std::uint64_t received = 0;
    std::uint64_t bad_frames = 0;
    std::uint64_t losses = 0;
  };

  void run(line::ByteLine line, const std::stop_token& stop);
  /// Reads and writes until the line is lost or the thread must end; returns the reason of a loss.
  [[nodiscard]] std::string serve(line::ByteLine& line, const std::stop_token& stop);
  /// Sends what the byte rate permits; returns the time of the next call.
  [[nodiscard]] Result<HostTime> write_due(line::ByteLine& line);
  void take(std::span<const char> bytes);

  line::Address address_;
  double byte_rate_ = 0;
  std::size_t queue_bytes_ = 0;
  std::size_t max_packet_bytes_ = 0;
  line::Wake wake_;
  PacketSink* sink_ = nullptr;
  std::optional<FrameDecoder> decoder_;  // of the driver's thread
  HostTime free_at_{};                   // ... earliest time of the next frame

  mutable std::mutex mutex_;  // guards the members below, except the thread
  std::deque<std::vector<std::byte>> queue_;
  std::size_t queued_bytes_ = 0;
  bool connected_ = false;
  State state_;
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

Status SerialTransmitter::configure(const HardwareSetup& setup,
                                    TransmitterDeclaration& declaration) {
  const Params params = setup.parameters();
  const bool serial = !params.text("device").empty();
  RAVE_TRY_ASSIGN(address_, line::read_address(params));
  byte_rate_ = params.number("byte_rate");
  // Ten bits per byte: eight data bits, a start and a stop bit.
  const double line_rate = serial ? static_cast<double>(params.integer("baud")) / 10 : 0;
  // The rate of the radio is at most that of the line.
  if (byte_rate_ == 0 || (line_rate > 0 && byte_rate_ > line_rate)) byte_rate_ = line_rate;
  queue_bytes_ = static_cast<std::size_t>(params.integer("queue_bytes"));
  max_packet_bytes_ = static_cast<std::size_t>(params.integer("max_packet_bytes"));
  if (queue_bytes_ < max_frame_bytes(max_packet_bytes_)) {
    return fail(ErrorCode::kInvalidArgument,
                "`queue_bytes` ({}) has no room for the longest packet in its frame ({})",
                queue_bytes_, max_frame_bytes(max_packet_bytes_));
  }
  RAVE_TRY(wake_.open());
  decoder_.emplace(max_packet_bytes_);
  declaration.max_packet_bytes = static_cast<std::uint32_t>(max_packet_bytes_);
  declaration.network = radio_name_hash(params.text("network"));
  declaration.boot = line::boot_number();
  return {};
}

Status SerialTransmitter::open(PacketSink& sink) {
  if (!decoder_) return fail(ErrorCode::kState, "opened before it was configured");
  if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
  wake_.clear();
  sink_ = &sink;
  RAVE_TRY_ASSIGN(auto line, line::ByteLine::open(address_, kConnect, nullptr));
  {
    const std::lock_guard lock(mutex_);
    queue_.clear();
    queued_bytes_ = 0;
    connected_ = true;
  }
  free_at_ = line::host_now();
  return start_thread(thread_, "the line",
                      [this, opened = std::move(line)](const std::stop_token& stop) mutable {
                        run(std::move(opened), stop);
                      });
}

Status SerialTransmitter::send(std::span<const std::byte> packet) {
  std::vector<std::byte> frame;
  frame.reserve(max_frame_bytes(packet.size()));
  append_frame(packet, frame);
  {
    const std::lock_guard lock(mutex_);
    if (!connected_) return fail(ErrorCode::kIo, "the line {} is lost", address_.text());
    if (queued_bytes_ + frame.size() > queue_bytes_) {
      ++state_.queue_full;
      return fail(ErrorCode::kIo, "the queue of the line {} is full", address_.text());
    }
    queued_bytes_ += frame.size();
    queue_.push_back(std::move(frame));
  }
  wake_.ring();
  return {};
}

void SerialTransmitter::close() { wake_.end(thread_); }

void SerialTransmitter::run(line::ByteLine line, const std::stop_token& stop) {
  std::optional<line::ByteLine> open_line(std::move(line));
  line::Backoff backoff;
  while (!stop.stop_requested()) {
    if (open_line) {
      const std::string why = serve(*open_line, stop);
      open_line.reset();
      if (stop.stop_requested()) return;
      {
        const std::lock_guard lock(mutex_);
        // Waiting packets are obsolete when the line is back.
        queue_.clear();
        queued_bytes_ = 0;
        connected_ = false;
        ++state_.losses;
      }
      sink_->fail(why.data(), why.size());
      backoff.reset();
    }
    if (wake_.wait(backoff.next())) wake_.clear();
    if (stop.stop_requested()) return;
    auto again = line::ByteLine::open(address_, kConnect, &wake_);
    if (!again) continue;
    open_line.emplace(*std::move(again));
    // Half a frame from before the loss must not be joined with new bytes.
    decoder_->restart();
    {
      const std::lock_guard lock(mutex_);
      connected_ = true;
    }
    sink_->recover();
  }
}

std::string SerialTransmitter::serve(line::ByteLine& line, const std::stop_token& stop) {
  std::array<char, 512> room{};
  while (!stop.stop_requested()) {
    const auto look_again = write_due(line);
    if (!look_again) return look_again.error().message;
    const auto got = line.read(room, line::until(*look_again), &wake_);
    // Clear the bell before looking: data that arrives in between rings it again.
    if (got.end == ReadEnd::kWoken) wake_.clear();
    if (got.end == ReadEnd::kLost) return line.lost();
    if (got.end == ReadEnd::kBytes) take({room.data(), got.size});
  }
  return {};
}

Result<HostTime> SerialTransmitter::write_due(line::ByteLine& line) {
  std::vector<std::byte> frame;
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      // send() rings the bell, so a long wait costs no delay.
      if (queue_.empty()) return line::host_now() + kIdle;
      if (line::host_now() < free_at_) return free_at_;
      frame = std::move(queue_.front());
      queue_.pop_front();
    }
    RAVE_TRY(
        line.write({reinterpret_cast<const char*>(frame.data()), frame.size()}, kConnect, nullptr));
    const std::lock_guard lock(mutex_);
    queued_bytes_ -= frame.size();
    ++state_.sent;
    state_.sent_bytes += frame.size();
    if (byte_rate_ > 0) {
      // The rate is that of the radio behind the line, which may be slower than the line itself.
      // Idle time is not saved up for a burst.
      const HostTime from = std::max(free_at_, line::host_now());
      free_at_ = line::after_seconds(from, static_cast<double>(frame.size()) / byte_rate_);
    }
  }
}

void SerialTransmitter::take(std::span<const char> bytes) {
  std::uint64_t good = 0;
  for (const char byte : bytes) {
    if (!decoder_->take(static_cast<std::byte>(byte))) continue;
    ++good;
    sink_->receive(decoder_->packet().data(), decoder_->packet().size());
  }
  const std::lock_guard lock(mutex_);
  state_.received += good;
  state_.bad_frames = decoder_->bad_frames();
}

std::string SerialTransmitter::report() const {
  const std::lock_guard lock(mutex_);
  nlohmann::ordered_json json;
  json["line"] = address_.text();
  json["byte_rate"] = byte_rate_;
  json["sent"] = state_.sent;
  json["sent_bytes"] = state_.sent_bytes;
  json["queue_full"] = state_.queue_full;
  json["received"] = state_.received;
  json["bad_frames"] = state_.bad_frames;
  json["losses"] = state_.losses;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace
}  // namespace rave::serial_transmitter

RAVE_PLUGIN("serial_transmitter") {
  rave::add_transmitter<rave::serial_transmitter::SerialTransmitter>(
      registry, {.name = "serial_transmitter",
                 .summary = "Carries messages as frames on a serial line, at its byte rate.",
                 .params = rave::serial_transmitter::kParams,
                 .clock = rave::DriverClock::kLive});
}
