// SPDX-License-Identifier: Apache-2.0
// A reader or writer of a topic.
#include "rave/ros2/end.hpp"

#include <algorithm>
#include <utility>

#include "rave/bus/endpoint.hpp"

namespace rave::ros2 {

Result<End> End::create(const Participant& participant, const dds_topic_descriptor_t& type,
                        std::string_view topic, const bus::QosProfile& profile, bool reads) {
  End end(participant, type.m_typename, topic, reads);
  RAVE_TRY_ASSIGN(end.entity_, participant.add_end(type, topic, profile, reads));
  return end;
}

End::End(End&& other) noexcept
    : participant_(other.participant_),
      type_(std::move(other.type_)),
      topic_(std::move(other.topic_)),
      reads_(other.reads_),
      entity_(std::exchange(other.entity_, 0)) {}

// Swapped, so that the end of `other` removes what this one had.
End& End::operator=(End&& other) noexcept {
  std::swap(participant_, other.participant_);
  std::swap(type_, other.type_);
  std::swap(topic_, other.topic_);
  std::swap(reads_, other.reads_);
  std::swap(entity_, other.entity_);
  return *this;
}

End::~End() {
  if (entity_ > 0) participant_->remove_end(entity_);
}

Status End::write(const void* sample) const {
  const dds_return_t code = dds_write(entity_, sample);
  if (code == DDS_RETCODE_OK) return {};
  return fail(ErrorCode::kIo, "cannot write `{}`: {}", topic_, dds_strretcode(code));
}

bool End::wait_until_there(Duration limit) const {
  return dds_wait_for_acks(entity_, limit.ns) == DDS_RETCODE_OK;
}

std::vector<dds_instance_handle_t> End::matched() const {
  std::vector<dds_instance_handle_t> ends(bus::matched_ends(entity_, reads_));
  if (ends.empty()) return ends;
  const dds_return_t count = reads_
                                 ? dds_get_matched_publications(entity_, ends.data(), ends.size())
                                 : dds_get_matched_subscriptions(entity_, ends.data(), ends.size());
  // Others may have come or gone since they were counted.
  ends.resize(std::min(ends.size(), static_cast<std::size_t>(std::max(count, 0))));
  return ends;
}

std::optional<RemoteId> End::identify(dds_instance_handle_t other) const {
  dds_builtintopic_endpoint_t* const found =
      reads_ ? dds_get_matched_publication_data(entity_, other)
             : dds_get_matched_subscription_data(entity_, other);
  if (found == nullptr) return std::nullopt;
  RemoteId id;
  std::ranges::copy(found->key.v, id.guid.begin());
  std::ranges::copy(found->participant_key.v, id.participant.begin());
  dds_builtintopic_free_endpoint(found);
  id.name = participant_->name_of(id.participant);
  return id;
}

std::optional<std::string> End::take_mismatch() const {
  return bus::take_mismatch(entity_, reads_);
}

std::string End::explain_silence() const {
  return participant_->explain_silence(topic_, type_, reads_);
}

}  // namespace rave::ros2
