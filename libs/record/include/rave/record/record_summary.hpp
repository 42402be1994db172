// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"

namespace rave::record {

/// One stream of a record.
struct ChannelSummary {
  std::string topic;
  std::string schema;
  std::string encoding;
  std::uint64_t messages = 0;
  double rate_hz = 0;  ///< Messages per second of the record's duration; 0 if it has none.
};

/// What `rave info` says about a record.
struct RecordSummary {
  std::uint64_t file_bytes = 0;
  bool ended = false;    ///< Ends as it should, with index and footer.
  bool checked = false;  ///< Every byte was looked at, not only index, beginning and end.
  std::vector<std::string> damages;   ///< What is wrong with it; empty: nothing that was looked at.
  std::vector<std::string> unsummed;  ///< If checked: pieces without a checksum.
  std::string profile;
  std::string library;
  double start_s = 0;  ///< Of the first and of the last message.
  double end_s = 0;
  std::uint64_t messages = 0;
  std::uint32_t chunks = 0;
  std::vector<ChannelSummary> channels;  ///< Those with messages, by topic.
  std::vector<AttachmentInfo> attachments;
  StringMap hybrids;  ///< `robot/sensor` to what it is made of; their parts are recorded.
  StringMap parts;    ///< The files that it was made of, and their bytes.
  std::vector<std::string> missing;  ///< ... and what is missing or torn of them.
  std::optional<RunInfo> run;        ///< None: not written by RAVE.
  std::optional<RunEnd> end;         ///< None: the run did not come to its end.
};

/// How much of a record is read.
enum class RecordLook : std::uint8_t {
  kIndex,  ///< Index, beginning and end: quick, says nothing about the data between.
  kAll,    ///< Everything, and the records it was made of as far as they are there.
};

/// Says what is in a record. Errors: kNotFound, kIo, kParse (no MCAP file).
[[nodiscard]] Result<RecordSummary> describe_record(const std::filesystem::path& path,
                                                    RecordLook look = RecordLook::kIndex);

/// Compares every checksum of a record and of those it was made of, as far as they are beside it.
/// Errors: as describe_record().
[[nodiscard]] Result<CheckedFile> check_record(const std::filesystem::path& path);

}  // namespace rave::record
