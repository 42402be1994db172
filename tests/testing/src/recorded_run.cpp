// SPDX-License-Identifier: Apache-2.0
#include "rave/run_testing/recorded_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "rave/record/mcap_writer.hpp"

namespace rave::cli_test {

Readings readings_of(const std::filesystem::path& path) {
  Readings readings;
  const auto reader = record::McapReader::open(path);
  EXPECT_TRUE(reader) << (reader ? "" : reader.error().text());
  if (!reader) return readings;
  const auto run = record::read_run_info(*reader);
  EXPECT_TRUE(run);
  if (!run) return readings;
  for (const record::RecordedSensor& sensor : run->sensors) {
    const std::string robot = run->robots[sensor.robot.value()].name;
    const auto all =
        record::read_samples(*reader, sensor.robot, sensor.sensor, record::PerceptPart::kResult);
    EXPECT_TRUE(all) << (all ? "" : all.error().text());
    if (!all) continue;
    auto& list = readings[robot + "/" + sensor.name];
    for (const auto& sample : all->samples) {
      const auto bytes = all->records_of(sample);
      list.emplace_back(sample.delivered.ns, sample.header.stamp_ns, sample.header.count,
                        std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
  }
  return readings;
}

std::string hash_of(const std::filesystem::path& path) {
  const auto reader = record::McapReader::open(path);
  EXPECT_TRUE(reader) << (reader ? "" : reader.error().text());
  const auto end = reader ? record::read_run_end(*reader) : std::nullopt;
  EXPECT_TRUE(end && end->hash);
  return end && end->hash ? fmt::format("{:016x}", *end->hash) : "";
}

void copy_record(const std::filesystem::path& from, const std::filesystem::path& to,
                 const Changes& changes) {
  const auto reader = record::McapReader::open(from);
  ASSERT_TRUE(reader) << reader.error().text();
  auto writer = record::McapWriter::open(to, {.chunk_bytes = changes.chunk_bytes});
  ASSERT_TRUE(writer) << writer.error().text();
  for (const auto& schema : reader->schemas()) {
    ASSERT_TRUE(writer->add_schema(schema.name, schema.encoding, schema.data));
  }
  std::map<std::uint16_t, std::uint16_t> ids;
  for (const auto& channel : reader->channels()) {
    if (changes.drops_channel && changes.drops_channel(channel.topic)) continue;
    const auto id = writer->add_channel(channel.topic, channel.message_encoding, channel.schema_id,
                                        channel.metadata);
    ASSERT_TRUE(id);
    ids[channel.id] = *id;
  }
  for (const auto& attachment : reader->attachments()) {
    if (changes.drops_attachment && changes.drops_attachment(attachment.name)) continue;
    auto text = reader->read_attachment(attachment);
    ASSERT_TRUE(text);
    if (changes.attachment) *text = changes.attachment(attachment.name, *text);
    ASSERT_TRUE(writer->add_attachment(attachment.name, attachment.media_type,
                                       std::as_bytes(std::span(*text))));
  }
  for (const auto& metadata : reader->metadata()) {
    auto entries = reader->read_metadata(metadata);
    ASSERT_TRUE(entries);
    if (changes.metadata) changes.metadata(metadata.name, *entries);
    ASSERT_TRUE(writer->add_metadata(metadata.name, *entries));
  }
  auto cursor = reader->messages();
  while (true) {
    const auto message = cursor.next();
    ASSERT_TRUE(message) << message.error().text();
    if (!*message) break;
    std::vector<std::byte> bytes((*message)->bytes.begin(), (*message)->bytes.end());
    const auto& channels = reader->channels();
    const auto channel = std::ranges::find(channels, (*message)->channel, &record::ChannelInfo::id);
    if (!ids.contains(channel->id)) continue;
    if (changes.drops && changes.drops(channel->topic, (*message)->log_time_ns)) continue;
    if (changes.message) changes.message(channel->topic, bytes);
    ASSERT_TRUE(writer->write(ids[channel->id], (*message)->sequence, (*message)->log_time_ns,
                              (*message)->publish_time_ns, bytes));
  }
  ASSERT_TRUE(writer->close());
}

}  // namespace rave::cli_test
