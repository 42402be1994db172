// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/writer.hpp"

namespace rave::ros2 {

Result<WriterCore> WriterCore::create(const Participant& participant,
                                      const dds_topic_descriptor_t& type, std::string_view topic,
                                      const bus::QosProfile& profile) {
  WriterCore core(participant, type.m_typename, topic);
  RAVE_TRY_ASSIGN(core.writer_, participant.add_end(type, topic, profile, false));
  return core;
}

WriterCore::WriterCore(WriterCore&& other) noexcept
    : participant_(other.participant_),
      type_(std::move(other.type_)),
      topic_(std::move(other.topic_)),
      writer_(std::exchange(other.writer_, 0)) {}

WriterCore& WriterCore::operator=(WriterCore&& other) noexcept {
  std::swap(participant_, other.participant_);
  std::swap(type_, other.type_);
  std::swap(topic_, other.topic_);
  std::swap(writer_, other.writer_);
  return *this;
}

WriterCore::~WriterCore() {
  if (writer_ > 0) dds_delete(writer_);
}

Status WriterCore::write(const void* sample) {
  const dds_return_t code = dds_write(writer_, sample);
  if (code == DDS_RETCODE_OK) return {};
  return fail(ErrorCode::kIo, "cannot write `{}`: {}", topic_, dds_strretcode(code));
}

bool WriterCore::wait_until_there(Duration limit) const {
  return dds_wait_for_acks(writer_, limit.ns) == DDS_RETCODE_OK;
}

std::string WriterCore::explain_silence() const {
  return participant_->explain_silence(topic_, type_, false);
}

}  // namespace rave::ros2
