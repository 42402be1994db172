// SPDX-License-Identifier: Apache-2.0
// A record is damaged wherever it can be; what is checked names the damage and is not whole.
#include <gtest/gtest.h>

#include <algorithm>

#include "mcap_format.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/record_summary.hpp"
#include "sample_run.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

class CheckedRecord : public ::testing::Test {
 protected:
  void SetUp() override {
    RunRecorderOptions options;
    options.file.chunk_bytes = 4096;
    options.file.flush_interval_s = 1000;
    auto recorder = RunRecorder::open(file_.path(), sample_info(), options);
    ASSERT_TRUE(recorder) << recorder.error().text();
    record_sample(*recorder, 50);
    ASSERT_TRUE(recorder->end(7));
    whole_ = file_.read();
    auto reader = McapReader::open(file_.path());
    ASSERT_TRUE(reader) << reader.error().text();
    reader_ = std::make_unique<McapReader>(*std::move(reader));
    ASSERT_GT(reader_->chunks().size(), 3U);
    ASSERT_FALSE(reader_->attachments().empty());
    ASSERT_FALSE(reader_->metadata().empty());
  }

  /// What is said about these bytes, all in one; empty: that they are whole.
  [[nodiscard]] std::string said_of(std::string_view bytes) const {
    file_.write(bytes);
    const auto summary = describe_record(file_.path(), RecordLook::kAll);
    if (!summary) return summary.error().text();
    EXPECT_TRUE(summary->checked);
    std::string text;
    for (const std::string& damage : summary->damages) text += damage + "\n";
    for (const std::string& piece : summary->unsummed) text += piece + "\n";
    EXPECT_TRUE(summary->ended || !text.empty()) << "cut, and nothing is said";
    return text;
  }
  [[nodiscard]] std::string flipped(std::size_t at) const {
    std::string bytes = whole_;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    return bytes;
  }
  [[nodiscard]] std::string zeroed(std::size_t at, std::size_t size) const {
    std::string bytes = whole_;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min(size, bytes.size() - at),
                '\0');
    return bytes;
  }
  void expect_said(const std::string& bytes, const std::string& expected,
                   const std::string& where) const {
    const std::string said = said_of(bytes);
    EXPECT_NE(said.find(expected), std::string::npos) << where << " is told as: " << said;
    EXPECT_NE(said.find(file_.path().string()), std::string::npos) << where << ": " << said;
  }
  /// The chunk with the only message of a topic.
  [[nodiscard]] const ChunkInfo& chunk_with(const char* topic) const {
    const std::uint16_t id = reader_->channel(topic)->id;
    return *std::ranges::find_if(reader_->chunks(), [id](const ChunkInfo& chunk) {
      return std::ranges::any_of(chunk.channels,
                                 [id](const auto& channel) { return channel.first == id; });
    });
  }
  /// Begin of the summary, after the footer.
  [[nodiscard]] std::uint64_t summary_at() const {
    std::uint64_t at = 0;
    std::memcpy(&at, whole_.data() + footer_at() + kRecordHead, sizeof at);
    return at;
  }
  [[nodiscard]] std::uint64_t footer_at() const {
    return whole_.size() - kMagic.size() - kFooterSize - kRecordHead;
  }

  TemporaryFile file_;
  std::string whole_;
  std::unique_ptr<McapReader> reader_;
};

TEST_F(CheckedRecord, IsWholeAsItWasWritten) { EXPECT_EQ(said_of(whole_), ""); }

TEST_F(CheckedRecord, EachPieceIsNamedWhenItIsDamaged) {
  expect_said(flipped(0), "is not an MCAP file", "mark");
  expect_said(flipped(kMagic.size()), "no complete header", "kind of the header");
  expect_said(flipped(kMagic.size() + kRecordHead + 4), "the header", "profile in the header");
  for (const ChunkInfo& chunk : reader_->chunks()) {
    const std::string name = fmt::format("the chunk at offset {}", chunk.offset);
    expect_said(flipped(chunk.offset + kRecordHead + 24), name, "checksum of a chunk");
    expect_said(flipped(chunk.offset + chunk.length / 2), name, "content of a chunk");
    expect_said(flipped(chunk.offset + chunk.length - 1), name, "end of a chunk");
    expect_said(flipped(chunk.offset + kRecordHead), "head or index of a chunk", "time of a chunk");
    if (chunk.message_index_length > 0) {
      expect_said(flipped(chunk.offset + chunk.length + kRecordHead + 8),
                  "head or index of a chunk", "index of messages");
    }
    expect_said(zeroed(chunk.offset + kRecordHead + 24, 4), name, "removed checksum of a chunk");
  }
  for (const AttachmentInfo& attachment : reader_->attachments()) {
    const std::string name = fmt::format("attachment `{}`", attachment.name);
    expect_said(flipped(attachment.offset), name, "kind of an attachment");
    expect_said(flipped(attachment.offset + attachment.length / 2), name, "attachment");
    expect_said(flipped(attachment.offset + attachment.length - 1), name, "its checksum");
    expect_said(zeroed(attachment.offset + attachment.length - 4, 4), name, "no checksum");
  }
  for (const MetadataInfo& metadata : reader_->metadata()) {
    expect_said(flipped(metadata.offset), fmt::format("metadata `{}`", metadata.name), "metadata");
    expect_said(flipped(metadata.offset + metadata.length - 1), "metadata", "value of metadata");
  }
  const std::uint64_t summary = summary_at();
  const std::string named = fmt::format("the summary at offset {}", summary);
  expect_said(flipped(summary - 1), "the data before offset", "checksum of the data");
  expect_said(zeroed(summary - 4, 4), "the data section has no checksum", "no checksum of data");
  expect_said(flipped(summary - 13), "the data do not end at offset", "end of the data");
  for (std::uint64_t at = summary; at < footer_at(); at += 97) {
    expect_said(flipped(at), named, "schemas, channels, counts and indexes of the summary");
  }
  expect_said(flipped(footer_at() + kRecordHead + 8), named, "footer");
  expect_said(flipped(footer_at() + kRecordHead + 16), named, "checksum of the summary");
  expect_said(zeroed(footer_at() + kRecordHead + 16, 4), "the index has no checksum",
              "no checksum of the summary");
  expect_said(flipped(footer_at()), "without a footer", "kind of the footer");
  expect_said(flipped(whole_.size() - 1), "without a footer", "mark at the end");
}

TEST_F(CheckedRecord, IsNotWholeWithMoreOrFewerMessagesThanItSays) {
  std::size_t at = summary_at();
  while (static_cast<std::uint8_t>(whole_.at(at)) != opcode::kStatistics) {
    std::uint64_t size = 0;
    std::memcpy(&size, whole_.data() + at + 1, sizeof size);
    at += kRecordHead + size;
  }
  std::uint64_t count = 0;
  std::memcpy(&count, whole_.data() + at + kRecordHead, sizeof count);
  ASSERT_EQ(count, reader_->statistics().message_count);
  for (const std::uint64_t said : {count - 1, count + 1}) {
    std::string bytes = whole_;
    std::memcpy(bytes.data() + at + kRecordHead, &said, sizeof said);
    // Without a checksum of the index nothing else tells.
    std::fill_n(bytes.end() - static_cast<std::ptrdiff_t>(kMagic.size() + 4), 4, '\0');
    expect_said(bytes, fmt::format("states {} messages; it has {}", said, count), "count");
  }
}

TEST_F(CheckedRecord, IsNotWholeWithOneByteChangedAnywhere) {
  for (std::size_t at = 0; at < whole_.size(); at += 13) {
    EXPECT_NE(said_of(flipped(at)), "") << "byte " << at << " of " << whole_.size();
  }
}

TEST_F(CheckedRecord, IsNotWholeWithAStretchOfItMissingOrEmptyOrTwice) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{20}, std::size_t{4096}}) {
    for (std::size_t at = 0; at < whole_.size(); at += whole_.size() / 11) {
      if (const std::string bytes = zeroed(at, size); bytes != whole_) {
        EXPECT_NE(said_of(bytes), "") << size << " zeros at " << at;
      }
      std::string shorter = whole_;
      shorter.erase(at, size);
      EXPECT_NE(said_of(shorter), "") << size << " bytes gone at " << at;
      std::string longer = whole_;
      longer.insert(at, whole_.substr(at, size));
      EXPECT_NE(said_of(longer), "") << size << " bytes twice at " << at;
    }
  }
  EXPECT_NE(said_of(whole_ + whole_), "");
  EXPECT_NE(said_of(whole_ + std::string(100, '\0')), "");
}

TEST_F(CheckedRecord, IsNotWholeWhereverItIsCut) {
  for (std::size_t size = 0; size < whole_.size(); size += whole_.size() / 40) {
    const std::string said = said_of(whole_.substr(0, size));
    EXPECT_NE(said.find(file_.path().string()), std::string::npos) << size << ": " << said;
  }
}

TEST_F(CheckedRecord, AFileWithoutIndexAndChecksumsIsNeverWhole) {
  std::string bytes = whole_.substr(0, summary_at());
  std::fill_n(bytes.end() - 4, 4, '\0');  // the checksum of the data
  std::string footer(kRecordHead + kFooterSize, '\0');
  footer[0] = static_cast<char>(opcode::kFooter);
  footer[1] = static_cast<char>(kFooterSize);
  const std::string said = said_of(bytes + footer + std::string(kMagic));
  EXPECT_NE(said.find("the index has no checksum"), std::string::npos) << said;
  EXPECT_NE(said.find("the data section has no checksum"), std::string::npos) << said;
}

TEST_F(CheckedRecord, WithoutTheLookAtAllOfItDamageInTheDataIsNotSeenAndNotDenied) {
  const ChunkInfo& chunk = reader_->chunks()[reader_->chunks().size() / 2];
  file_.write(flipped(chunk.offset + chunk.length / 2));
  const auto quick = describe_record(file_.path());
  ASSERT_TRUE(quick);
  EXPECT_FALSE(quick->checked);
  EXPECT_TRUE(quick->damages.empty());
}

TEST_F(CheckedRecord, ABeginningOrEndThatCannotBeReadIsDamageAlsoWithoutIt) {
  file_.write(flipped(chunk_with(topic::kRun).offset + kRecordHead + 24));
  auto quick = describe_record(file_.path());
  ASSERT_TRUE(quick);
  EXPECT_FALSE(quick->run);
  ASSERT_EQ(quick->damages.size(), 1U);
  EXPECT_EQ(quick->damages[0], "its beginning (`/rave/run`, `scenario.yaml`) cannot be read");
  file_.write(flipped(chunk_with(topic::kEnd).offset + kRecordHead + 24));
  quick = describe_record(file_.path());
  ASSERT_TRUE(quick);
  EXPECT_TRUE(quick->run);
  EXPECT_FALSE(quick->end);
  ASSERT_EQ(quick->damages.size(), 1U);
  EXPECT_EQ(quick->damages[0], "its end (`/rave/end`) cannot be read");
}

}  // namespace
}  // namespace rave::record
