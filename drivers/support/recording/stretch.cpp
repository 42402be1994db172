// SPDX-License-Identifier: Apache-2.0
#include "recording/stretch.hpp"

#include <algorithm>
#include <optional>

#include "rave/base/file.hpp"
#include "recording/stamp.hpp"
#include "recording/unpack.hpp"

namespace rave::recording {
namespace {

constexpr std::string_view kStretchFile = "stretch.txt";
constexpr std::size_t kLargestStretchFile = std::size_t{1} << 20;

struct Draft {
  std::optional<std::int64_t> origin_ns;
  std::optional<std::int64_t> start_ns;
  std::optional<std::int64_t> end_ns;
  std::map<std::string, std::string, std::less<>> sha256;
};

bool is_digest(std::string_view text) noexcept {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

Status take_time(std::optional<std::int64_t>& target, std::string_view key, std::string_view value,
                 const SourceLocation& where) {
  // A key given twice is an error: one of the two would be ignored silently.
  if (target) return fail_at(where, ErrorCode::kParse, "`{}` is given twice", key);
  target = parse_stamp_ns(value);
  if (target) return {};
  return fail_at(where, ErrorCode::kParse,
                 "`{}` is `{}`: expected seconds with at most nine decimals", key, value);
}

Status take_digest(Draft& draft, std::string_view value, const SourceLocation& where) {
  const std::size_t blank = value.find(' ');
  if (blank == std::string_view::npos || !is_digest(value.substr(0, blank))) {
    return fail_at(where, ErrorCode::kParse,
                   "expected `sha256: `, 64 lower-case hexadecimal digits and a file name");
  }
  const std::string name(value.substr(blank + 1));
  if (draft.sha256.emplace(name, value.substr(0, blank)).second) return {};
  return fail_at(where, ErrorCode::kParse, "file `{}` is given twice", name);
}

Status take_line(Draft& draft, std::string_view line, const SourceLocation& where) {
  if (line.empty() || line.front() == '#') return {};
  const std::size_t colon = line.find(": ");
  const std::string_view key = line.substr(0, colon);
  const std::string_view value =
      colon == std::string_view::npos ? std::string_view() : line.substr(colon + 2);
  if (key == "origin_s") return take_time(draft.origin_ns, key, value, where);
  if (key == "start_s") return take_time(draft.start_ns, key, value, where);
  if (key == "end_s") return take_time(draft.end_ns, key, value, where);
  if (key == "sha256") return take_digest(draft, value, where);
  return fail_at(where, ErrorCode::kParse,
                 "expected one of `origin_s: `, `start_s: `, `end_s: ` and `sha256: `");
}

}  // namespace

Result<Stretch> parse_stretch(std::string_view text, const std::string& file) {
  Draft draft;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t newline = text.find('\n');
    std::string_view content = text.substr(0, newline);
    text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
    // Files that were edited on other systems end lines with \r\n.
    while (!content.empty() && (content.back() == '\r' || content.back() == ' ')) {
      content.remove_suffix(1);
    }
    RAVE_TRY(take_line(draft, content, {file, line, 0}));
  }
  if (!draft.origin_ns || !draft.start_ns || !draft.end_ns) {
    return fail_at({file, 0, 0}, ErrorCode::kParse,
                   "expected all of `origin_s`, `start_s` and `end_s`");
  }
  if (*draft.start_ns >= *draft.end_ns) {
    return fail_at({file, 0, 0}, ErrorCode::kParse, "`start_s` must be less than `end_s`");
  }
  return Stretch{*draft.origin_ns, *draft.start_ns, *draft.end_ns, std::move(draft.sha256)};
}

Result<std::optional<Stretch>> read_stretch(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kStretchFile;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  RAVE_TRY_ASSIGN(const std::string text, read_file(path, kLargestStretchFile));
  return parse_stretch(text, path.string());
}

Result<LogIdentity> identify(const std::filesystem::path& path, std::string_view bytes,
                             const std::vector<Repair>& repairs,
                             const std::optional<Stretch>& stretch) {
  LogIdentity log{path.filename().string(), sha256_hex(bytes), std::nullopt, {}};
  if (!stretch) return log;
  log.beside.emplace_back(kStretchFile);
  const auto listed = stretch->sha256.find(log.file);
  if (listed == stretch->sha256.end()) return log;
  log.unchanged = listed->second == log.sha256;
  const auto cut = std::ranges::find(repairs, RepairKind::kCutLine, &Repair::kind);
  if (*log.unchanged || cut != repairs.end()) return log;
  return fail_at({path.string(), 0, 0}, ErrorCode::kParse,
                 "the file differs from the one that {} lists (SHA-256 {}, listed {}); restore it",
                 kStretchFile, log.sha256, listed->second);
}

}  // namespace rave::recording
