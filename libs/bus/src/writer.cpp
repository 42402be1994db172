// SPDX-License-Identifier: Apache-2.0
// What is sent by the local transport if all readers can be reached with it, otherwise by DDS.
#include "rave/bus/writer.hpp"

#include "rave/bus/endpoint.hpp"
#include "rave/bus/local_transport.hpp"

namespace rave::bus {

Result<WriterCore> WriterCore::create(Bus& bus, const TopicSpec& topic) {
  WriterCore core;
  RAVE_TRY_ASSIGN(const Bus::Endpoint* const endpoint, core.add(bus, topic, false));
  core.local_ = endpoint->sender.get();
  return core;
}

bool WriterCore::goes_locally(const void* sample) {
  if (local_ == nullptr) return false;
  // The transport knows the readers by address and DDS by discovery. If the numbers differ, a
  // reader is on another machine or has just come, and the sample goes by DDS, which reaches all.
  if (local_->due()) {
    const std::size_t count = readers();
    if (local_->readers() != count) bus_->meet(*bus_->endpoint(entity_));
    if (local_->readers() != count) return false;
    local_->counted();
  }
  return local_->send(sample);
}

Status WriterCore::write(const void* sample) {
  if (goes_locally(sample)) return {};
  const dds_return_t code = dds_write(entity_, sample);
  if (code == DDS_RETCODE_OK) return {};
  if (code == DDS_RETCODE_TIMEOUT) {
    return fail(ErrorCode::kTimeout, "{}: a reader is too slow", topic_);
  }
  return fail(ErrorCode::kInvalidArgument, "{}: the sample cannot be sent: {}", topic_,
              dds_strretcode(code));
}

Status WriterCore::dispose(const void* key) {
  const dds_return_t code = dds_dispose(entity_, key);
  if (code == DDS_RETCODE_OK) return {};
  return fail(ErrorCode::kState, "{}: cannot dispose: {}", topic_, dds_strretcode(code));
}

std::size_t WriterCore::readers() const { return matched_ends(entity_, false); }

}  // namespace rave::bus
