// SPDX-License-Identifier: Apache-2.0
#include "rave/record/record_summary.hpp"

#include <algorithm>

#include "rave/record/mcap_reader.hpp"

namespace rave::record {
namespace {

/// Decodes the first message of a topic; what is missing or damaged is none.
template <class Decode>
auto first_of(const McapReader& reader, const char* topic, Decode decode) -> std::optional<
    typename std::invoke_result_t<Decode, std::span<const std::byte>>::value_type> {
  const ChannelInfo* channel = reader.channel(topic);
  if (channel == nullptr) return std::nullopt;
  MessageCursor cursor = reader.messages({{channel->id}});
  const auto message = cursor.next();
  if (!message || !*message) return std::nullopt;
  auto decoded = decode((*message)->bytes);
  if (!decoded) return std::nullopt;
  return *std::move(decoded);
}

}  // namespace

Result<RecordSummary> describe_record(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const auto reader, McapReader::open(path));
  const Statistics& statistics = reader.statistics();
  RecordSummary summary;
  summary.file_bytes = reader.file_size();
  summary.whole = reader.whole();
  summary.damages = reader.damages();
  summary.profile = reader.profile();
  summary.library = reader.library();
  summary.start_s = static_cast<double>(statistics.start_ns) * 1e-9;
  summary.end_s = static_cast<double>(statistics.end_ns) * 1e-9;
  summary.messages = statistics.message_count;
  summary.chunks = statistics.chunk_count;
  summary.attachments = reader.attachments();
  for (const MetadataInfo& metadata : reader.metadata()) {
    if (metadata.name != kHybridMetadata) continue;
    if (auto entries = reader.read_metadata(metadata)) summary.hybrids = *std::move(entries);
  }
  const double duration_s = summary.end_s - summary.start_s;
  for (const ChannelInfo& channel : reader.channels()) {
    const auto count = statistics.channel_message_counts.find(channel.id);
    if (count == statistics.channel_message_counts.end()) continue;
    const SchemaInfo* schema = reader.schema(channel.schema_id);
    const auto messages = static_cast<double>(count->second);
    summary.channels.push_back({channel.topic, schema == nullptr ? "" : schema->name,
                                channel.message_encoding, count->second,
                                duration_s > 0 ? messages / duration_s : 0});
  }
  std::ranges::sort(summary.channels, {}, &ChannelSummary::topic);
  summary.run = first_of(reader, topic::kRun, decode_run);
  summary.end = first_of(reader, topic::kEnd, decode_end);
  if (summary.run) {
    const auto yaml =
        std::ranges::find(summary.attachments, "scenario.yaml", &AttachmentInfo::name);
    if (yaml != summary.attachments.end()) {
      if (auto text = reader.read_attachment(*yaml)) {
        summary.run->expanded_scenario = *std::move(text);
      }
    }
  }
  return summary;
}

}  // namespace rave::record
