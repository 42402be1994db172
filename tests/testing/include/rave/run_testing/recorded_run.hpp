// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "rave/record/run_reader.hpp"

namespace rave::cli_test {

/// What the record of a run says that a sensor read: when it was handed over, stamp, count, bytes.
using Reading = std::tuple<std::int64_t, std::int64_t, std::uint32_t, std::string>;
using Readings = std::map<std::string, std::vector<Reading>>;  ///< By `robot/sensor`.

[[nodiscard]] Readings readings_of(const std::filesystem::path& record);
[[nodiscard]] std::string hash_of(const std::filesystem::path& record);

/// Copies a record message by message. `change(topic, bytes)` may alter a message; `text` an
/// attachment or the value of a metadata entry.
struct Changes {
  std::function<void(const std::string& topic, std::vector<std::byte>& bytes)> message;
  /// Whether a message is left out, with its topic and time.
  std::function<bool(const std::string& topic, std::uint64_t time_ns)> drops;
  std::function<std::string(const std::string& name, std::string text)> attachment;
  /// Whether a channel is left out with its messages; the ids of others stay.
  std::function<bool(const std::string& topic)> drops_channel;
  /// Whether an attachment is left out.
  std::function<bool(const std::string& name)> drops_attachment;
  std::function<void(const std::string& name, record::StringMap& entries)> metadata;
  std::size_t chunk_bytes = std::size_t{1} << 20;
};
void copy_record(const std::filesystem::path& from, const std::filesystem::path& to,
                 const Changes& changes);

}  // namespace rave::cli_test
