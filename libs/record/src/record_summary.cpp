// SPDX-License-Identifier: Apache-2.0
// What `rave info` says of a recording.
#include "rave/record/record_summary.hpp"

#include <algorithm>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/merge.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::record {
namespace {

namespace fs = std::filesystem;

/// Whether the record has messages of a topic.
bool has(const McapReader& reader, const char* topic) {
  const ChannelInfo* const channel = reader.channel(topic);
  return channel != nullptr && reader.statistics().channel_message_counts.contains(channel->id);
}

/// The existing files that the recording was merged from.
std::vector<fs::path> parts_of(const McapReader& reader, const fs::path& path) {
  std::vector<fs::path> parts;
  for (const auto& [name, bytes] : merged_files(reader)) {
    std::error_code error;
    const fs::path part = path.parent_path() / name;
    if (fs::is_regular_file(part, error)) parts.push_back(part);
  }
  return parts;
}

void add(const std::vector<std::string>& from, std::vector<std::string>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

CheckedFile check_all(const McapReader& reader, const fs::path& path) {
  CheckedFile checked = reader.check();
  for (const fs::path& part : parts_of(reader, path)) {
    const auto of_part = McapReader::open(part);
    if (!of_part) {
      checked.damages.push_back(of_part.error().message);
      continue;
    }
    const CheckedFile found = of_part->check();
    // A truncated part was merged as far as possible, and missing_parts() reports it.
    if (missing_parts(reader).empty()) add(found.cuts, checked.damages);
    add(found.damages, checked.damages);
    add(found.unsummed, checked.unsummed);
  }
  return checked;
}

void look_at_all(const McapReader& reader, const fs::path& path, RecordSummary& summary) {
  const CheckedFile checked = check_all(reader, path);
  summary.checked = true;
  summary.damages = checked.cuts;
  add(checked.damages, summary.damages);
  summary.unsummed = checked.unsummed;
}

/// Data that exists but cannot be read is damage, not absence.
void read_ends(const McapReader& reader, RecordSummary& summary) {
  if (auto run = read_run_info(reader)) summary.run = *std::move(run);
  summary.end = read_run_end(reader);
  if (!summary.damages.empty()) return;
  if (!summary.run && has(reader, topic::kRun)) {
    summary.damages.push_back(
        fmt::format("its beginning (`{}`, `scenario.yaml`) cannot be read", topic::kRun));
  }
  if (!summary.end && has(reader, topic::kEnd)) {
    summary.damages.push_back(fmt::format("its end (`{}`) cannot be read", topic::kEnd));
  }
}

void note_lost(const McapReader& reader, RecordSummary& summary) {
  // While a file is damaged or truncated, that is the reason.
  if (!summary.ended || !summary.damages.empty()) return;
  if (!summary.run) {
    // The disk may have been full from the beginning.
    if (reader.channel(topic::kRun) == nullptr) return;
    summary.lost.push_back(fmt::format("the description of the run (`{}`)", topic::kRun));
    return;
  }
  if (summary.run->expanded_scenario.empty()) {
    summary.lost.emplace_back(
        "its scenario (attachment `scenario.yaml`): it cannot be shown, played or verified");
  }
  for (const char* const topic :
       {topic::kPoses, topic::kPercepts, topic::kCommands, topic::kActuators, topic::kEvents}) {
    if (reader.channel(topic) == nullptr)
      summary.lost.push_back(fmt::format("the stream `{}`", topic));
  }
}

}  // namespace

Result<CheckedFile> check_record(const fs::path& path) {
  RAVE_TRY_ASSIGN(const auto reader, McapReader::open(path));
  return check_all(reader, path);
}

Result<RecordSummary> describe_record(const fs::path& path, RecordLook look) {
  RAVE_TRY_ASSIGN(const auto reader, McapReader::open(path));
  const Statistics& statistics = reader.statistics();
  RecordSummary summary;
  summary.file_bytes = reader.file_size();
  summary.ended = reader.ended();
  summary.damages = reader.damages();
  // Reads every byte, and those of all parts, so only where it is asked for.
  if (look == RecordLook::kAll) look_at_all(reader, path, summary);
  summary.profile = reader.profile();
  summary.library = reader.library();
  summary.start_s = static_cast<double>(statistics.start_ns) * 1e-9;
  summary.end_s = static_cast<double>(statistics.end_ns) * 1e-9;
  summary.messages = statistics.message_count;
  summary.chunks = statistics.chunk_count;
  summary.attachments = reader.attachments();
  summary.hybrids = reader.metadata_named(kHybridMetadata);
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
  read_ends(reader, summary);
  note_lost(reader, summary);
  return summary;
}

}  // namespace rave::record
