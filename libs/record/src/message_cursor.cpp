// SPDX-License-Identifier: Apache-2.0
// Messages in the order of time from chunks that may overlap. Only chunks around the present time
// are in memory.
#include "message_cursor.hpp"

#include <algorithm>

namespace rave::record {

MessageCursor::MessageCursor(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
MessageCursor::MessageCursor(MessageCursor&&) noexcept = default;
MessageCursor& MessageCursor::operator=(MessageCursor&&) noexcept = default;
MessageCursor::~MessageCursor() = default;

Result<std::optional<MessageView>> MessageCursor::next() { return impl_->next(); }

MessageCursor::Impl::Impl(std::shared_ptr<const RecordFile> file, MessageFilter filter)
    : file_(std::move(file)), filter_(std::move(filter)), open_(file_->chunks.size()) {
  std::ranges::sort(filter_.channels);
  for (std::size_t i = 0; i < file_->chunks.size(); ++i) {
    if (wanted(file_->chunks[i])) waiting_.push_back(i);
  }
  // Backward, so that the next one is taken from the end.
  std::ranges::sort(waiting_, [this](std::size_t a, std::size_t b) {
    const auto& first = file_->chunks[a];
    const auto& second = file_->chunks[b];
    return first.start_ns != second.start_ns ? first.start_ns > second.start_ns : a > b;
  });
}

bool MessageCursor::Impl::wanted(const ChunkInfo& chunk) const {
  if (chunk.end_ns < filter_.from_ns || chunk.start_ns > filter_.to_ns) return false;
  // A chunk whose channels are not known may have all of them.
  if (filter_.channels.empty() || chunk.channels.empty()) return true;
  return std::ranges::any_of(chunk.channels, [this](const auto& channel) {
    return std::ranges::binary_search(filter_.channels, channel.first);
  });
}

Status MessageCursor::Impl::open_chunk(std::size_t index) {
  const ChunkInfo& info = file_->chunks[index];
  auto chunk = std::make_unique<OpenChunk>();
  RAVE_TRY(load_chunk(*file_, info, chunk->records));
  const auto add = [&](const MessageView& message, std::size_t at, std::size_t size) {
    const bool inside =
        message.log_time_ns >= filter_.from_ns && message.log_time_ns <= filter_.to_ns &&
        (filter_.channels.empty() || std::ranges::binary_search(filter_.channels, message.channel));
    if (inside) chunk->places.push_back({message.log_time_ns, at, size});
  };
  const bool complete = for_each_message(chunk->records, add);
  // Sorted here, since a chunk keeps messages in the order in which they were written. Stable, so
  // that those of one time keep that order.
  if (!chunk->places.empty()) {
    std::ranges::stable_sort(chunk->places, {}, &Place::log_time_ns);
    heads_.push({chunk->places.front().log_time_ns, index});
    open_[index] = std::move(chunk);
  }
  if (complete) return {};
  return fail(ErrorCode::kParse, "`{}`: the chunk at offset {} has an incomplete record",
              file_->source->name(), info.offset);
}

Result<std::optional<MessageView>> MessageCursor::Impl::next() {
  // The last message was a view into this chunk, so it could not be freed before.
  if (spent_) {
    open_[*spent_].reset();
    spent_.reset();
  }
  // Chunks may overlap in time. Those that begin no later than the next message are open, and the
  // earliest message of all of them is next; the others wait unread.
  while (!waiting_.empty() &&
         (heads_.empty() || file_->chunks[waiting_.back()].start_ns <= heads_.top().log_time_ns)) {
    const std::size_t index = waiting_.back();
    waiting_.pop_back();
    RAVE_TRY(open_chunk(index));
  }
  if (heads_.empty()) return std::optional<MessageView>{};
  const std::size_t index = heads_.top().chunk;
  heads_.pop();
  OpenChunk& chunk = *open_[index];
  const Place& place = chunk.places[chunk.next++];
  MessageView message;
  static_cast<void>(
      get_message(ByteSpan(chunk.records).subspan(place.offset, place.size), message));
  if (chunk.next < chunk.places.size()) {
    heads_.push({chunk.places[chunk.next].log_time_ns, index});
  } else {
    spent_ = index;
  }
  return std::optional<MessageView>(message);
}

}  // namespace rave::record
