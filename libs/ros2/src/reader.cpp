// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/reader.hpp"

namespace rave::ros2 {

Result<ReaderCore> ReaderCore::create(const Participant& participant,
                                      const dds_topic_descriptor_t& type, std::string_view topic,
                                      const bus::QosProfile& profile) {
  ReaderCore core(participant, type.m_typename, topic);
  RAVE_TRY_ASSIGN(core.reader_, participant.add_end(type, topic, profile, true));
  return core;
}

ReaderCore::ReaderCore(ReaderCore&& other) noexcept
    : participant_(other.participant_),
      type_(std::move(other.type_)),
      topic_(std::move(other.topic_)),
      reader_(std::exchange(other.reader_, 0)),
      refused_(other.refused_),
      trouble_(std::move(other.trouble_)) {}

ReaderCore& ReaderCore::operator=(ReaderCore&& other) noexcept {
  std::swap(participant_, other.participant_);
  std::swap(type_, other.type_);
  std::swap(topic_, other.topic_);
  std::swap(reader_, other.reader_);
  std::swap(refused_, other.refused_);
  std::swap(trouble_, other.trouble_);
  return *this;
}

ReaderCore::~ReaderCore() {
  if (reader_ > 0) dds_delete(reader_);
}

void ReaderCore::refuse(Error why) {
  ++refused_;
  trouble_ = std::move(why.message);
}

std::string ReaderCore::explain_silence() const {
  return participant_->explain_silence(topic_, type_, true);
}

}  // namespace rave::ros2
