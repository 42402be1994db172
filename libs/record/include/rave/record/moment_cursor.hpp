// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"

namespace rave::record {

/// Iterates over a recording by log time: all messages of one time together, by topic, copied.
class MomentCursor {
 public:
  using Bytes = std::vector<std::byte>;
  using Messages = std::map<std::string_view, std::vector<Bytes>>;

  /// The texts of `topics` must outlive the cursor; topics that the recording does not have are
  /// ignored.
  MomentCursor(const McapReader& reader, const std::vector<std::string_view>& topics);

  /// Loads the next time; false at the end. Errors: those of MessageCursor::next().
  [[nodiscard]] Result<bool> next();

  [[nodiscard]] std::uint64_t time_ns() const noexcept { return time_ns_; }
  [[nodiscard]] const Messages& messages() const noexcept { return messages_; }
  /// The messages of one topic, in the order in which they were written.
  [[nodiscard]] const std::vector<Bytes>& messages(std::string_view topic) const;
  /// Whether the loaded time is the last one.
  [[nodiscard]] bool at_last() const noexcept { return !ahead_; }

 private:
  [[nodiscard]] Status take();

  std::map<std::uint16_t, std::string_view> topic_of_;
  std::optional<MessageCursor> cursor_;  ///< Empty: the recording has none of the topics.
  Messages messages_;
  std::uint64_t time_ns_ = 0;
  std::optional<Bytes> ahead_;
  std::uint64_t ahead_time_ns_ = 0;
  std::string_view ahead_topic_;
  bool started_ = false;
};

}  // namespace rave::record
