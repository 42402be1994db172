// SPDX-License-Identifier: Apache-2.0
// What is sent by the local transport if all readers can be reached with it, otherwise by DDS.
#include "rave/bus/writer.hpp"

#include "rave/bus/endpoint.hpp"
#include "rave/bus/local_transport.hpp"

namespace rave::bus {

Result<WriterCore> WriterCore::create(Bus& bus, const TopicSpec& topic) {
  WriterCore core;
  core.bus_ = &bus;
  core.topic_ = topic.name;
  RAVE_TRY_ASSIGN(core.writer_, bus.add_endpoint(topic, false));
  core.local_ = bus.endpoint(core.writer_)->sender.get();
  return core;
}

WriterCore& WriterCore::operator=(WriterCore&& other) noexcept {
  std::swap(bus_, other.bus_);
  std::swap(topic_, other.topic_);
  std::swap(writer_, other.writer_);
  std::swap(local_, other.local_);
  return *this;
}

WriterCore::~WriterCore() {
  if (writer_ > 0) bus_->remove_endpoint(writer_);
}

bool WriterCore::goes_locally(const void* sample) {
  if (local_ == nullptr) return false;
  // The transport knows the readers by address and DDS by discovery. If the numbers differ, a
  // reader is on another machine or has just come, and the sample goes by DDS, which reaches all.
  if (local_->due()) {
    const std::size_t count = readers();
    if (local_->readers() != count) bus_->meet(*bus_->endpoint(writer_));
    if (local_->readers() != count) return false;
    local_->counted();
  }
  return local_->send(sample);
}

Status WriterCore::write(const void* sample) {
  if (goes_locally(sample)) return {};
  const dds_return_t code = dds_write(writer_, sample);
  if (code == DDS_RETCODE_OK) return {};
  if (code == DDS_RETCODE_TIMEOUT) {
    return fail(ErrorCode::kTimeout, "{}: a reader is too slow", topic_);
  }
  return fail(ErrorCode::kInvalidArgument, "{}: the sample cannot be sent: {}", topic_,
              dds_strretcode(code));
}

Status WriterCore::dispose(const void* key) {
  const dds_return_t code = dds_dispose(writer_, key);
  if (code == DDS_RETCODE_OK) return {};
  return fail(ErrorCode::kState, "{}: cannot dispose: {}", topic_, dds_strretcode(code));
}

std::size_t WriterCore::readers() const { return matched_ends(writer_, false); }

}  // namespace rave::bus
