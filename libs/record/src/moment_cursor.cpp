// SPDX-License-Identifier: Apache-2.0
// The messages of a recording, all those of one moment together.
#include "rave/record/moment_cursor.hpp"

namespace rave::record {

MomentCursor::MomentCursor(const McapReader& reader, const std::vector<std::string_view>& topics) {
  MessageFilter filter;
  for (const std::string_view topic : topics) {
    const ChannelInfo* const channel = reader.channel(topic);
    if (channel == nullptr) continue;
    topic_of_[channel->id] = topic;
    filter.channels.push_back(channel->id);
  }
  // A filter without channels would accept all messages.
  if (!filter.channels.empty()) cursor_.emplace(reader.messages(std::move(filter)));
}

Result<bool> MomentCursor::next() {
  messages_.clear();
  if (!started_) {
    started_ = true;
    RAVE_TRY(take());
  }
  if (!ahead_) return false;
  time_ns_ = ahead_time_ns_;
  // One message is read ahead: only it tells that a moment is over.
  while (ahead_ && ahead_time_ns_ == time_ns_) {
    messages_[ahead_topic_].push_back(*std::move(ahead_));
    RAVE_TRY(take());
  }
  return true;
}

const std::vector<MomentCursor::Bytes>& MomentCursor::messages(std::string_view topic) const {
  static const std::vector<Bytes> kNone;
  const auto found = messages_.find(topic);
  return found == messages_.end() ? kNone : found->second;
}

Status MomentCursor::take() {
  ahead_.reset();
  if (!cursor_) return {};
  RAVE_TRY_ASSIGN(const auto message, cursor_->next());
  if (!message) return {};
  ahead_ = Bytes(message->bytes.begin(), message->bytes.end());
  ahead_time_ns_ = message->log_time_ns;
  ahead_topic_ = topic_of_[message->channel];
  return {};
}

}  // namespace rave::record
