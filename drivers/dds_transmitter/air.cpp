// SPDX-License-Identifier: Apache-2.0
#include "dds_transmitter/air.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/line/host_clock.hpp"

namespace rave::dds_transmitter {
namespace {

/// Period of polling for events that wake no reader: matches and refusals.
constexpr line::Wait kLook{50};
/// Limit of writers that a warning is logged for.
constexpr std::size_t kMostComplaints = 1000;

/// The networks that this process has joined.
/// All robots of a process that use one network share one participant of DDS, because each
/// participant costs threads, ports and discovery. The robots hear each other directly; DDS does
/// not return what a process writes itself.
struct Airs {
  std::mutex mutex;
  std::vector<std::pair<AirOptions, std::weak_ptr<Air>>> all;
};

Airs& airs() {
  static Airs airs;
  return airs;
}

}  // namespace

Result<std::shared_ptr<Air>> Air::join(const AirOptions& options) {
  Airs& known = airs();
  const std::lock_guard lock(known.mutex);
  std::erase_if(known.all, [](const auto& entry) { return entry.second.expired(); });
  for (const auto& [of, air] : known.all) {
    if (of != options) continue;
    // Weak: the network is left when its last robot closes.
    if (auto shared = air.lock()) return shared;
  }
  std::shared_ptr<Air> air(new Air(options));
  RAVE_TRY(air->open());
  known.all.emplace_back(options, air);
  return air;
}

Status Air::open() {
  RAVE_TRY_ASSIGN(bus_, bus::Bus::open(bus_config(options_)));
  RAVE_TRY_ASSIGN(auto writer, bus::Writer<bus::Packet>::create(*bus_));
  writer_.emplace(std::move(writer));
  RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::Packet>::create(*bus_));
  reader_.emplace(std::move(reader));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus_));
  waits_.emplace(std::move(waits));
  encoded_.resize(options_.max_packet_bytes);
  return waits_->add(*reader_);
}

Status Air::attach(const AirPlace& place) {
  const std::lock_guard one(thread_mutex_);
  {
    const std::lock_guard lock(places_mutex_);
    places_.push_back(place);
  }
  if (thread_.joinable()) return {};
  Status started =
      start_thread(thread_, "the network", [this](const std::stop_token& stop) { run(stop); });
  if (!started) {
    const std::lock_guard lock(places_mutex_);
    places_.clear();
  }
  return started;
}

void Air::detach(const AirPlace& place) {
  const std::lock_guard one(thread_mutex_);
  bool last = false;
  {
    const std::lock_guard lock(places_mutex_);
    std::erase_if(places_, [&](const AirPlace& other) { return other.sink == place.sink; });
    last = places_.empty();
  }
  if (!last || !thread_.joinable()) return;
  thread_.request_stop();
  waits_->ring();
  thread_.join();
}

Status Air::send(std::span<const std::byte> bytes, const AirPlace& from) {
  const auto packet = decode_radio_packet(bytes);
  if (!packet || bytes.size() > options_.max_packet_bytes) {
    return fail(ErrorCode::kInvalidArgument, "{} bytes are not a packet of at most {}",
                bytes.size(), options_.max_packet_bytes);
  }
  {
    const std::lock_guard lock(queue_mutex_);
    // The queue bounds what the network may owe. A step never waits for the network.
    if (waiting_.bytes.size() + bytes.size() > options_.queue_bytes) {
      ++counts_.not_sent;
      return fail(ErrorCode::kIo, "the queue to the network is full ({} bytes)",
                  options_.queue_bytes);
    }
    waiting_.bytes.insert(waiting_.bytes.end(), bytes.begin(), bytes.end());
    waiting_.sizes.push_back(bytes.size());
  }
  waits_->ring();
  const std::lock_guard lock(places_mutex_);
  for (const AirPlace& place : places_) {
    if (place.sink != from.sink) place.sink->receive(bytes.data(), bytes.size());
  }
  return {};
}

AirCounts Air::counts() const {
  const std::lock_guard lock(queue_mutex_);
  return counts_;
}

void Air::run(const std::stop_token& stop) {
  auto look_at = line::host_now();
  while (!stop.stop_requested()) {
    write_waiting();
    take();
    if (line::host_now() >= look_at) {
      look();
      look_at = line::host_now() + kLook;
    }
    static_cast<void>(waits_->wait(Duration{line::until(look_at).count() * 1'000'000}));
  }
  write_waiting();
}

void Air::write_waiting() {
  writing_.bytes.clear();
  writing_.sizes.clear();
  {
    const std::lock_guard lock(queue_mutex_);
    // Swapped under the lock and written outside of it, so that send() never waits for DDS. Both
    // keep their memory.
    std::swap(writing_, waiting_);
  }
  std::uint64_t sent = 0;
  std::size_t begin = 0;
  for (const std::size_t size : writing_.sizes) {
    const auto packet = decode_radio_packet(std::span(writing_.bytes).subspan(begin, size));
    begin += size;
    if (!packet) continue;
    bus::Packet sample = sample_of(*packet, ++number_);
    if (writer_->write(sample)) ++sent;
  }
  if (writing_.sizes.empty()) return;
  const std::lock_guard lock(queue_mutex_);
  counts_.sent += sent;
  counts_.not_sent += writing_.sizes.size() - sent;
}

void Air::take() {
  const std::size_t taken = reader_->take([this](const bus::Packet& sample) { hand_out(sample); });
  if (taken == 0) return;
  const std::lock_guard lock(queue_mutex_);
  counts_.received += taken;
}

void Air::hand_out(const bus::Packet& sample) {
  const std::lock_guard lock(places_mutex_);
  std::uint32_t encoded_for = 0;
  std::size_t size = 0;
  for (const AirPlace& place : places_) {
    if (size == 0 || place.network != encoded_for) {
      const auto packet = packet_of(sample, place.network, options_.max_packet_bytes);
      if (!packet) {
        reader_->refuse(sample, packet.error().message);
        return;
      }
      size = encode(*packet, encoded_);
      encoded_for = place.network;
    }
    place.sink->receive(encoded_.data(), size);
  }
}

void Air::look() {
  for (const bus::BusEvent& event : bus_->take_events()) {
    using enum bus::EventKind;
    switch (event.kind) {
      case kParticipantAppeared:
      case kParticipantLost:
        tell(LogLevel::kInfo, event.line());
        break;
      case kRefused:
        // A sender of invalid samples sends many, so only the first is logged.
        if (complained_of_.size() < kMostComplaints && complained_of_.insert(event.writer).second) {
          tell(LogLevel::kWarning, event.line());
        }
        break;
      case kIncompatible:
      case kForeignRun:
      case kNotice:
        tell(LogLevel::kWarning, event.line());
        break;
      default:
        break;
    }
  }
  const std::lock_guard lock(queue_mutex_);
  counts_.refused = bus_->refused_samples();
  counts_.foreign = bus_->foreign_samples();
  counts_.others = writer_->readers();
}

void Air::tell(LogLevel level, const std::string& text) {
  const std::lock_guard lock(places_mutex_);
  if (!places_.empty()) places_.front().host.write(level, text);
}

}  // namespace rave::dds_transmitter
