// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <string_view>
#include <utility>

#include "people/audit_lines.hpp"
#include "rave/web/rate_limit.hpp"

namespace rave::gui_server {

/// Who did what, as lines of JSON in `audit.jsonl` of a folder, which is turned over at 4 MiB, four
/// older ones kept. It must never be given a secret. Any thread.
class AuditLog {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 20U;
  static constexpr int kOlderOnes = 4;
  using Fields = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  /// An empty folder: nothing is kept.
  explicit AuditLog(std::filesystem::path folder, std::uintmax_t most_bytes = kMostBytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  /// `what`: `login`, `refused`, `stop`, `right`, ...; a field that is empty is left out. What
  /// cannot be written, as on a full disk, is lost: the server continues without it, and counts it.
  void note(std::string_view what, Fields fields);
  [[nodiscard]] std::uint64_t lost() const;
  /// Lines that this process has written.
  [[nodiscard]] std::uint64_t written() const;
  /// Those of all files that fit the filter, newest first. Waits for the disk; reads 20 MiB at
  /// most.
  [[nodiscard]] AuditPage read(const AuditFilter& filter) const;
  /// Whether lines are kept at all.
  [[nodiscard]] bool keeps() const noexcept { return !folder_.empty(); }

 private:
  void turn_over();
  [[nodiscard]] bool is_too_many(std::string_view what, Fields fields);

  std::filesystem::path folder_;
  std::uintmax_t most_bytes_;
  mutable std::mutex mutex_;
  std::uint64_t lost_ = 0;
  std::uint64_t written_ = 0;
  web::RateLimit refusals_{0.1, 50};
};

}  // namespace rave::gui_server
