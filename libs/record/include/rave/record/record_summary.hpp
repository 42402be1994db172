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

/// One stream of a recording.
struct ChannelSummary {
  std::string topic;
  std::string schema;
  std::string encoding;
  std::uint64_t messages = 0;
  double rate_hz = 0;  ///< Messages per second of the recording's duration; 0 if the duration is 0.
};

/// The content of `rave info` for a recording.
struct RecordSummary {
  std::uint64_t file_bytes = 0;
  bool ended = false;                ///< Has index and footer.
  bool checked = false;              ///< Every byte was checked, not only index, beginning and end.
  std::vector<std::string> damages;  ///< Problems found; empty: none in the part that was checked.
  std::vector<std::string> unsummed;  ///< Parts without a checksum; filled if `checked`.
  std::string profile;
  std::string library;
  double start_s = 0;  ///< Log time of the first message.
  double end_s = 0;
  std::uint64_t messages = 0;
  std::uint32_t chunks = 0;
  std::vector<ChannelSummary> channels;  ///< Those with messages, by topic.
  std::vector<AttachmentInfo> attachments;
  StringMap hybrids;  ///< Hybrid sensors whose parts are recorded: `robot/sensor` to a description
                      ///< of the parts.
  StringMap parts;    ///< The files that were merged into it, with their sizes.
  std::vector<std::string> missing;  ///< Missing or truncated files among them.
  /// What a run always records and this recording has lost, such as in a tool that copied it; one
  /// sentence each.
  std::vector<std::string> lost;
  std::optional<RunInfo> run;  ///< None: not written by RAVE.
  std::optional<RunEnd> end;   ///< Empty: the run did not end.
};

/// How much of a recording is read.
enum class RecordLook : std::uint8_t {
  kIndex,  ///< Index, beginning and end: fast, but the data between is not checked.
  kAll,    ///< Everything, including the recordings that were merged into it, if present.
};

/// Summarises a recording. Errors: kNotFound, kIo, kParse (not an MCAP file).
[[nodiscard]] Result<RecordSummary> describe_record(const std::filesystem::path& path,
                                                    RecordLook look = RecordLook::kIndex);

/// Verifies every checksum of a recording, and of the recordings merged into it if they are beside
/// it. Errors: those of describe_record().
[[nodiscard]] Result<CheckedFile> check_record(const std::filesystem::path& path);

}  // namespace rave::record
