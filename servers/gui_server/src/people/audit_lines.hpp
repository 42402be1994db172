// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The audit log, read back. Plain values, no threads.
namespace rave::gui_server {

/// Who did what. What a line does not have is empty.
struct AuditLine {
  std::string time;  ///< ISO 8601, UTC.
  std::string what;
  std::string user;
  std::string why;
  std::string by;
  std::string from;
  std::string detail;
};

/// Its parts by their names in the file and in messages; all but the first two may be missing.
inline constexpr std::array<std::pair<const char*, std::string AuditLine::*>, 7> kAuditFields = {
    {{"time", &AuditLine::time},
     {"what", &AuditLine::what},
     {"user", &AuditLine::user},
     {"why", &AuditLine::why},
     {"by", &AuditLine::by},
     {"from", &AuditLine::from},
     {"detail", &AuditLine::detail}}};

/// Which lines.
struct AuditFilter {
  std::string what;      ///< Only of this kind; empty: of all.
  std::string contains;  ///< In any part of the line, capitals or not; empty: all.
  std::size_t most = 200;
};

struct AuditPage {
  std::vector<AuditLine> lines;  ///< Newest first; at most AuditFilter::most.
  bool more = false;             ///< There are older ones.
};

/// Adds the lines of a file of the log, the last first. What is no line of it is left out, as a
/// last one that is not whole.
void add_audit_lines(std::string_view text, const AuditFilter& filter, AuditPage& page);

}  // namespace rave::gui_server
