// SPDX-License-Identifier: Apache-2.0
#include "recording/line_parser.hpp"

namespace rave::recording {

Status LineParser::parse_lines(const UnpackedText& log) {
  std::string_view rest = log.text;
  while (!rest.empty()) {
    ++line_;
    const std::size_t newline = rest.find('\n');
    const bool terminated = newline != std::string_view::npos;
    line_text_ = rest.substr(0, newline);
    rest.remove_prefix(terminated ? newline + 1 : rest.size());
    if (!terminated && log.cut) {
      RAVE_TRY(take_cut("the gzip stream ends in the middle of this line"));
      continue;
    }
    words_ = split(line_text_);
    if (words_.empty() || words_.front().text.front() == '#') continue;
    RAVE_TRY(terminated ? take_line() : take_last_line());
  }
  if (!log.cut || cut_reported_) return {};
  ++line_;
  line_text_ = {};
  return take_cut("the gzip stream is truncated after the previous line");
}

Status LineParser::take_cut(std::string_view what) {
  cut_reported_ = true;
  if (!accept_cut_) {
    return fail_at({file_, line_, static_cast<int>(line_text_.size()) + 1}, ErrorCode::kParse,
                   "{}; fetch the whole file, or set accept_cut to use the {}", what, whole());
  }
  add_repair(cut_repairs(), RepairKind::kCutLine, 1, line_);
  return {};
}

}  // namespace rave::recording
