// SPDX-License-Identifier: Apache-2.0
#include "rave/record/record_summary.hpp"

#include <algorithm>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/merge.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::record {
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
  summary.parts = merged_files(reader);
  summary.missing = missing_parts(reader);
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
  if (auto run = read_run_info(reader)) summary.run = *std::move(run);
  summary.end = read_run_end(reader);
  return summary;
}

}  // namespace rave::record
