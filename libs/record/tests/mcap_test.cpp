// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <mutex>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/mcap_writer.hpp"
#include "temporary_file.hpp"
#include "write_queue.hpp"

namespace rave::record {
namespace {

class CollectingSink final : public LogSink {
 public:
  void write(LogLevel, std::string_view, std::string_view message) override {
    const std::lock_guard lock(mutex_);
    lines_.emplace_back(message);
  }
  [[nodiscard]] std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

McapWriterOptions small_chunks() {
  McapWriterOptions options;
  options.chunk_bytes = 256;
  options.flush_interval_s = 1000;  // chunks by size alone: the same file in every run
  return options;
}

/// 20 messages on each of two channels, an attachment and metadata, in several chunks.
void write_sample(const std::filesystem::path& path) {
  auto writer = McapWriter::open(path, small_chunks());
  ASSERT_TRUE(writer) << writer.error().text();
  const auto schema = writer->add_schema("a/msg/A", "ros2msg", "uint8 x\n");
  const auto first = writer->add_channel("/first", "cdr", *schema, {{"key", "value"}});
  const auto second = writer->add_channel("/second", "cdr", *schema);
  ASSERT_TRUE(writer->add_metadata("about", {{"seed", "7"}}));
  for (std::uint32_t i = 0; i < 20; ++i) {
    ASSERT_TRUE(writer->write(*first, i, 100 * i, 100 * i + 1, bytes_of(fmt::format("f{}", i))));
    ASSERT_TRUE(writer->write(*second, i, 100 * i, 100 * i, bytes_of(fmt::format("second {}", i))));
  }
  ASSERT_TRUE(
      writer->add_attachment("scenario.yaml", "application/yaml", bytes_of("name: x\n"), 5));
  const Status closed = writer->close();
  ASSERT_TRUE(closed) << closed.error().text();
}

/// All messages, `topic@time:content` each; an error as its text.
std::vector<std::string> all_messages(const McapReader& reader, MessageFilter filter = {}) {
  std::vector<std::string> found;
  MessageCursor cursor = reader.messages(std::move(filter));
  while (true) {
    const auto message = cursor.next();
    if (!message) {
      found.push_back("error: " + message.error().text());
      continue;
    }
    if (!*message) return found;
    const MessageView& view = **message;
    const auto channel = std::ranges::find(reader.channels(), view.channel, &ChannelInfo::id);
    found.push_back(fmt::format("{}#{}@{}:{}",
                                channel == reader.channels().end() ? "?" : channel->topic,
                                view.sequence, view.log_time_ns, text_of(view.bytes)));
  }
}

TEST(Mcap, ReadsBackWhatWasWritten) {
  const TemporaryFile file;
  write_sample(file.path());
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_TRUE(reader->whole());
  EXPECT_TRUE(reader->damages().empty());
  EXPECT_EQ(reader->profile(), "ros2");
  EXPECT_EQ(reader->library(), "rave");
  ASSERT_EQ(reader->schemas().size(), 1U);
  EXPECT_EQ(reader->schemas()[0].data, "uint8 x\n");
  ASSERT_EQ(reader->channels().size(), 2U);
  EXPECT_EQ(reader->channels()[0].metadata.at("key"), "value");
  EXPECT_EQ(reader->statistics().message_count, 40U);
  EXPECT_EQ(reader->statistics().start_ns, 0U);
  EXPECT_EQ(reader->statistics().end_ns, 1900U);
  EXPECT_EQ(reader->statistics().channel_message_counts.at(2), 20U);
  EXPECT_GT(reader->chunks().size(), 3U);
  const auto messages = all_messages(*reader);
  ASSERT_EQ(messages.size(), 40U);
  EXPECT_EQ(messages[0], "/first#0@0:f0");
  EXPECT_EQ(messages[1], "/second#0@0:second 0");
  EXPECT_EQ(messages[39], "/second#19@1900:second 19");
  ASSERT_EQ(reader->attachments().size(), 1U);
  EXPECT_EQ(reader->read_attachment(reader->attachments()[0]).value(), "name: x\n");
  ASSERT_EQ(reader->metadata().size(), 1U);
  EXPECT_EQ(reader->read_metadata(reader->metadata()[0])->at("seed"), "7");
  EXPECT_TRUE(reader->check().whole());
}

TEST(Mcap, TheIndexSaysWhatTheChunksHold) {
  const TemporaryFile file;
  write_sample(file.path());
  const std::string bytes = file.read();
  const auto reader = McapReader::open_memory(bytes_of(bytes), "whole");
  ASSERT_TRUE(reader && reader->whole());
  // Without its footer the file is gone through, and the chunks speak for themselves.
  const auto scanned = McapReader::open_memory(bytes_of(bytes).first(bytes.size() - 1), "cut");
  ASSERT_TRUE(scanned);
  std::vector<ChunkInfo> indexed;
  for (const ChunkInfo& chunk : reader->chunks()) {
    if (!chunk.channels.empty()) indexed.push_back(chunk);
  }
  ASSERT_GT(indexed.size(), 3U);
  ASSERT_EQ(indexed.size(), scanned->chunks().size());
  for (std::size_t i = 0; i < indexed.size(); ++i) {
    const ChunkInfo& found = scanned->chunks()[i];
    EXPECT_EQ(indexed[i].offset, found.offset);
    EXPECT_EQ(indexed[i].length, found.length);
    EXPECT_EQ(indexed[i].start_ns, found.start_ns);
    EXPECT_EQ(indexed[i].end_ns, found.end_ns);
    EXPECT_EQ(indexed[i].uncompressed_size, found.uncompressed_size);
    ASSERT_EQ(indexed[i].channels.size(), found.channels.size());
    for (std::size_t c = 0; c < found.channels.size(); ++c) {
      const auto [channel, at] = indexed[i].channels[c];
      EXPECT_EQ(channel, found.channels[c].first);
      // A message index: its kind, its length, the channel.
      ASSERT_LT(at + 11, bytes.size());
      EXPECT_EQ(bytes[at], '\x07');
      EXPECT_EQ(static_cast<std::uint8_t>(bytes[at + 9]), channel);
    }
  }
}

TEST(Mcap, FiltersByChannelAndTime) {
  const TemporaryFile file;
  write_sample(file.path());
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  const auto id = reader->channel("/second")->id;
  EXPECT_EQ(all_messages(*reader, {{id}, 300, 500}),
            (std::vector<std::string>{"/second#3@300:second 3", "/second#4@400:second 4",
                                      "/second#5@500:second 5"}));
  EXPECT_EQ(reader->channel("/third"), nullptr);
}

TEST(Mcap, AMillionMessagesComeInOrderOfTime) {
  const TemporaryFile file;
  constexpr std::uint32_t kCount = 1'000'000;
  {
    McapWriterOptions options;
    options.chunk_bytes = 1 << 18;
    auto writer = McapWriter::open(file.path(), options);
    ASSERT_TRUE(writer);
    const auto channel = writer->add_channel("/x", "cdr", 0);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      // Neighbours exchanged, and each tenth one late by far more than a chunk.
      const std::uint64_t time = i % 10 == 9 && i > 50'000 ? i - 50'000 : i ^ 1U;
      ASSERT_TRUE(writer->write(*channel, i, time, time, std::as_bytes(std::span(&i, 1))));
    }
    ASSERT_TRUE(writer->close());
  }
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  std::uint64_t last = 0, count = 0, sum = 0;
  bool ordered = true;
  MessageCursor cursor = reader->messages();
  while (true) {
    const auto message = cursor.next();
    ASSERT_TRUE(message) << message.error().text();
    if (!*message) break;
    ordered = ordered && (*message)->log_time_ns >= last;
    last = (*message)->log_time_ns;
    std::uint32_t value = 0;
    std::memcpy(&value, (*message)->bytes.data(), sizeof value);
    EXPECT_EQ(value, (*message)->sequence);
    sum += value;
    ++count;
  }
  EXPECT_TRUE(ordered);
  EXPECT_EQ(count, kCount);
  EXPECT_EQ(sum, std::uint64_t{kCount} * (kCount - 1) / 2);
}

TEST(Mcap, CutAtEveryByteGivesABeginningOfTheMessages) {
  const TemporaryFile file;
  write_sample(file.path());
  const std::string whole = file.read();
  const auto complete = McapReader::open(file.path());
  ASSERT_TRUE(complete);
  const auto expected = all_messages(*complete);
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    const auto reader = McapReader::open_memory(bytes_of(cut), "cut");
    if (!reader) {
      EXPECT_NE(reader.error().text().find("cut"), std::string::npos);
      continue;
    }
    EXPECT_FALSE(reader->whole()) << size;
    ASSERT_FALSE(reader->damages().empty()) << size;
    const auto messages = all_messages(*reader);
    ASSERT_LE(messages.size(), expected.size());
    EXPECT_TRUE(std::equal(messages.begin(), messages.end(), expected.begin())) << size;
    EXPECT_GE(messages.size(), most) << size;
    most = messages.size();
  }
  EXPECT_EQ(most, expected.size());
}

TEST(Mcap, AChangedByteIsNoticedWhereverItIs) {
  const TemporaryFile file;
  write_sample(file.path());
  const std::string whole = file.read();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x20);
    const auto reader = McapReader::open_memory(bytes_of(changed), "changed");
    if (!reader) continue;
    const CheckedFile checked = reader->check();
    EXPECT_FALSE(checked.cuts.empty() && checked.damages.empty()) << "byte " << at;
  }
}

TEST(Mcap, ADamagedChunkIsNamedAndTheOthersAreRead) {
  const TemporaryFile file;
  write_sample(file.path());
  auto content = file.read();
  const auto before = McapReader::open(file.path());
  ASSERT_TRUE(before);
  const ChunkInfo chunk = before->chunks()[1];
  const std::size_t all = all_messages(*before).size();
  content[chunk.offset + 9 + 24] ^= 1;  // the checksum in the chunk's head
  file.write(content);
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  const auto messages = all_messages(*reader);
  const auto bad = std::ranges::count_if(messages, [&](const std::string& text) {
    return text.find(fmt::format("{}`: the chunk at offset {} does not match its checksum",
                                 file.path().string(), chunk.offset)) != std::string::npos;
  });
  EXPECT_EQ(bad, 1);
  EXPECT_GT(messages.size(), all / 2);
  EXPECT_LT(messages.size(), all);
}

TEST(Mcap, ADamagedSummaryIsSaidAndReplacedByAScan) {
  const TemporaryFile file;
  write_sample(file.path());
  auto content = file.read();
  content[content.size() - 8 - 29 - 5] ^= 1;
  const auto reader = McapReader::open_memory(bytes_of(content), "x.mcap");
  ASSERT_TRUE(reader);
  ASSERT_EQ(reader->damages().size(), 1U);
  EXPECT_NE(reader->damages()[0].find("does not match its checksum"), std::string::npos);
  EXPECT_EQ(all_messages(*reader).size(), 40U);
  EXPECT_EQ(reader->attachments().size(), 1U);
  EXPECT_EQ(reader->metadata().size(), 1U);
}

TEST(Mcap, SaysWhatIsNoRecord) {
  const auto wrong = McapReader::open_memory(bytes_of("%PDF-1.7 and much more text"), "a.pdf");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().text(), "`a.pdf` is not an MCAP file (wrong magic bytes)");
  const auto missing = McapReader::open("/nowhere/x.mcap");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text(), "cannot open `/nowhere/x.mcap`: No such file or directory");
}

TEST(Mcap, WriterRefusesWhatIsNotThere) {
  const TemporaryFile file;
  auto writer = McapWriter::open(file.path());
  ASSERT_TRUE(writer);
  EXPECT_EQ(writer->write(3, 0, 0, 0, {}).error().text(),
            "message for channel 3, which does not exist");
  EXPECT_EQ(writer->add_channel("/x", "cdr", 2).error().text(),
            "channel `/x` names schema 2, which does not exist");
  ASSERT_TRUE(writer->close());
  EXPECT_TRUE(writer->close());
  EXPECT_EQ(writer->write(1, 0, 0, 0, {}).error().text(), "the recording is closed");
  EXPECT_EQ(McapWriter::open("/nowhere/x.mcap").error().code, ErrorCode::kNotFound);
  McapWriterOptions odd;
  odd.zstd_level = 99;
  EXPECT_EQ(McapWriter::open(file.path(), odd).error().code, ErrorCode::kInvalidArgument);
}

TEST(Mcap, WhatCannotBeCompressedInTimeIsWrittenAsItIs) {
  McapWriterOptions options;
  EXPECT_EQ(level_for(options, options.backlog_bytes / 10), 1);
  EXPECT_EQ(level_for(options, options.backlog_bytes / 10 + 1), -5);
  EXPECT_EQ(level_for(options, options.backlog_bytes / 2), -5);
  EXPECT_EQ(level_for(options, options.backlog_bytes / 2 + 1), std::nullopt);
  options.zstd_level = -7;
  EXPECT_EQ(level_for(options, options.backlog_bytes / 2), -7);

  for (const std::size_t backlog_bytes : {std::size_t{1}, std::size_t{64} << 20}) {
    const TemporaryFile file;
    options = {};
    options.chunk_bytes = 4096;
    options.flush_interval_s = 1000;
    options.backlog_bytes = backlog_bytes;  // of 1: each chunk is more than half of what may wait
    auto writer = McapWriter::open(file.path(), options);
    ASSERT_TRUE(writer);
    const auto channel = writer->add_channel("/x", "cdr", 0);
    const std::string content(5000, 'x');
    ASSERT_TRUE(writer->write(*channel, 0, 0, 0, bytes_of(content)));
    ASSERT_TRUE(writer->close());
    const auto reader = McapReader::open(file.path());
    ASSERT_TRUE(reader) << reader.error().text();
    EXPECT_TRUE(reader->check().whole());
    EXPECT_EQ(all_messages(*reader), (std::vector<std::string>{"/x#0@0:" + content}));
    EXPECT_EQ(std::filesystem::file_size(file.path()) > 5000, backlog_bytes == 1);
  }
}

TEST(Mcap, ADiskThatIsFullIsToldOnceAndLeavesAReadableFile) {
  const TemporaryFile file;
  CollectingSink sink;
  auto writer = McapWriter::open(file.path(), small_chunks(), &sink);
  ASSERT_TRUE(writer);
  const auto channel = writer->add_channel("/x", "cdr", 0);
  for (std::uint32_t i = 0; i < 20; ++i) ASSERT_TRUE(writer->write(*channel, i, i, i, {}));
  ASSERT_TRUE(writer->flush());
  const auto size = std::filesystem::file_size(file.path());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full{size + 100, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  for (std::uint32_t i = 20; i < 40; ++i) static_cast<void>(writer->write(*channel, i, i, i, {}));
  const Status flushed = writer->flush();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_FALSE(flushed);
  EXPECT_NE(flushed.error().text().find(fmt::format("at offset {}: File too large", size)),
            std::string::npos)
      << flushed.error().text();
  EXPECT_FALSE(writer->write(*channel, 40, 40, 40, {}));
  EXPECT_EQ(writer->dropped(), 21U);
  EXPECT_FALSE(writer->close());
  ASSERT_EQ(sink.lines().size(), 1U);
  EXPECT_NE(sink.lines()[0].find("the run continues, its recording ends here"), std::string::npos);
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_TRUE(reader->whole());
  EXPECT_TRUE(reader->check().whole());
  EXPECT_EQ(all_messages(*reader).size(), 20U);
}

TEST(Mcap, ReadsFilesWithoutChunksAndWithoutSummary) {
  std::string text = "\x89MCAP0\r\n";
  const auto record = [&text](char code, const std::string& content) {
    text += code;
    const std::uint64_t size = content.size();
    text.append(reinterpret_cast<const char*>(&size), 8);
    text += content;
  };
  using namespace std::string_literals;
  record(1, "\0\0\0\0\0\0\0\0"s);
  record(4, "\x07\0\0\0\x02\0\0\0/a\x04\0\0\0json\0\0\0\0"s);
  record(5, "\x07\0\x01\0\0\0\x09\0\0\0\0\0\0\0\x09\0\0\0\0\0\0\0{}"s);
  record(5, "\x07\0\x02\0\0\0\x08\0\0\0\0\0\0\0\x08\0\0\0\0\0\0\0[]"s);
  record(15, "\0\0\0\0"s);
  record(2, std::string(20, '\0'));
  text += "\x89MCAP0\r\n";
  const auto reader = McapReader::open_memory(bytes_of(text), "plain");
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_TRUE(reader->whole());
  EXPECT_TRUE(reader->damages().empty());
  EXPECT_EQ(all_messages(*reader), (std::vector<std::string>{"/a#2@8:[]", "/a#1@9:{}"}));
  EXPECT_TRUE(reader->check().damages.empty());
}

}  // namespace
}  // namespace rave::record
