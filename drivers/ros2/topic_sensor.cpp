// SPDX-License-Identifier: Apache-2.0
#include "ros2/topic_sensor.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace rave::ros2_driver {

Status TopicSensor::configure(const HardwareSetup& setup, HardwareDeclaration& declaration) {
  device_ = static_cast<Ros2Device*>(setup.device);
  if (device_ == nullptr) return fail(ErrorCode::kState, "has no `device`");
  declaration.clock = DriverClock::kLive;
  RAVE_TRY(prepare(setup.parameters(), declaration));
  ready_ = true;
  return {};
}

Status TopicSensor::open(SampleSink& sink) {
  if (!ready_) return fail(ErrorCode::kState, "opened before it was configured");
  if (sink_ != nullptr) return fail(ErrorCode::kState, "opened twice; close it first");
  {
    const std::lock_guard lock(mutex_);
    // Messages that waited since configure() are old, and their arrival says nothing about the
    // clock.
    drain();
    sink_ = &sink;
    state_ = {};
    look_after(state_);
    refused_at_open_ = std::exchange(state_.refused, 0);
    next_told_ = 1;
    clock_.restart();
    last_ = line::host_now();
    last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
    lost_ = false;
    alive_ = false;
  }
  // The device counts its sensors and those that are silent. If all are silent the robot itself
  // counts as away, and its drive refuses commands.
  if (!may_be_silent_) device_->count_listening(true);
  for (const dds_entity_t reader : readers()) {
    RAVE_TRY_ASSIGN(const dds_entity_t condition, device_->waiter().watch(reader));
    watched_.push_back(condition);
  }
  device_->attach(*this);
  return {};
}

void TopicSensor::close() {
  if (sink_ == nullptr) return;
  device_->detach(*this);
  for (const dds_entity_t condition : watched_) device_->waiter().forget(condition);
  watched_.clear();
  const std::lock_guard lock(mutex_);
  if (std::exchange(lost_, false)) device_->count_silent(false);
  if (!may_be_silent_) device_->count_listening(false);
  sink_ = nullptr;
}

line::HostTime TopicSensor::attend(line::HostTime now) {
  const std::lock_guard lock(mutex_);
  drain();
  state_.refused = 0;
  look_after(state_);
  tell_refused();
  if (may_be_silent_) return line::HostTime::max();
  if (std::exchange(alive_, false)) {
    refused_before_ = state_.refused;
    if (std::exchange(lost_, false)) {
      device_->count_silent(false);
      sink_->recover();
    }
    return line::HostTime::max();
  }
  const line::HostTime lost_at = line::after_seconds(last_, device_->options().timing.lost_after_s);
  // The time to look again: nothing while it is lost, because only a message can change that.
  if (lost_ || now < lost_at) return lost_ ? line::HostTime::max() : lost_at;
  lost_ = true;
  ++state_.losses;
  device_->count_silent(true);
  const bool refused = state_.refused > refused_before_;
  state_.trouble = fmt::format(
      "no {}message has come on `{}` for {} s: {}", refused ? "usable " : "", topic(),
      device_->options().timing.lost_after_s, refused ? state_.trouble : explain_silence());
  sink_->fail(state_.trouble.data(), state_.trouble.size());
  return line::HostTime::max();
}

// Not each: a robot whose every message is refused would fill the log.
void TopicSensor::tell_refused() {
  const std::uint64_t refused = state_.refused - refused_at_open_;
  if (refused < next_told_) return;
  device_->log(LogLevel::kWarning, fmt::format("`{}`: {} message{} refused so far: {}", topic(),
                                               refused, refused == 1 ? "" : "s", state_.trouble));
  while (next_told_ <= refused) next_told_ *= 10;
}

void TopicSensor::publish(std::int64_t stamp_ns, const void* records, std::uint32_t count) {
  if (sink_ == nullptr) return;
  const line::HostTime now = line::host_now();
  const StreamClock::Taken taken = clock_.take(stamp_ns, line::host_seconds(now));
  if (!taken.good) return;
  if (taken.anew) {
    const std::string text = fmt::format(
        "the clock of the sender of `{}` was set, or it began anew; how late its messages are is "
        "not known",
        topic());
    sink_->begin_anew(text.data(), text.size());
  }
  last_ = now;
  alive_ = true;
  if (state_.samples++ == 0) {
    first_ = now;
  } else if (now > first_) {
    state_.rate_hz = static_cast<double>(state_.samples - 1) /
                     std::chrono::duration<double>(now - first_).count();
  }
  // Sender times never decrease, but a better clock estimate may shift them back.
  const SimTime moment =
      line::run_stamp(*sink_, taken.host_s - device_->options().timing.latency_s);
  last_stamp_ns_ = std::max(moment.ns, last_stamp_ns_);
  (void)sink_->publish(SimTime{last_stamp_ns_}, records, count);
}

bool TopicSensor::admits(WriterChoice& choice, const ros2::End& reader,
                         dds_instance_handle_t writer, std::string_view frame, bool is_static) {
  const double patience_s =
      is_static ? std::numeric_limits<double>::infinity() : device_->options().timing.lost_after_s;
  auto ruling = choice.judge(*device_, reader, writer, patience_s, frame);
  if (!ruling.counts) ++state_.passed_over;
  if (ruling.changed) clock_.restart();
  if (!ruling.news.empty()) warn(std::move(ruling.news), state_);
  return ruling.counts;
}

void TopicSensor::note_alive() {
  last_ = line::host_now();
  alive_ = true;
}

void TopicSensor::warn(std::string text, TopicState& state) const {
  device_->log(LogLevel::kWarning, text);
  state.trouble = std::move(text);
}

std::string TopicSensor::report() const {
  if (!ready_) return "{}";
  const std::lock_guard lock(mutex_);
  nlohmann::ordered_json json;
  json["topic"] = topic();
  json["samples"] = state_.samples;
  json["rate_hz"] = state_.rate_hz;
  json["refused"] = state_.refused;
  json["old"] = clock_.old();
  json["early"] = clock_.early();
  json["restarts"] = clock_.restarts();
  json["losses"] = state_.losses;
  json["passed_over"] = state_.passed_over;
  json["clock_drift_ppm"] = clock_.drift_ppm();
  json["trouble"] = state_.trouble;
  // Texts of other nodes may not be UTF-8, which JSON requires.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rave::ros2_driver
