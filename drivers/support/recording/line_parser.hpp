// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "recording/stream_report.hpp"
#include "recording/tokens.hpp"
#include "recording/unpack.hpp"

namespace rave::recording {

/// Walks over the lines of a log of words; `#` starts a comment line, blank lines are skipped. A
/// log may end in the middle: its last line has no newline, or the gzip stream is truncated. That
/// is an error by default, because a download that broke off would otherwise be a shorter run.
class LineParser {
 protected:
  /// `file` is not owned. `accept_cut`: leave out a truncated last line, and report it.
  LineParser(const std::string& file, bool accept_cut) : file_(file), accept_cut_(accept_cut) {}
  ~LineParser() = default;

  Status parse_lines(const UnpackedText& log);

  /// Handles the line whose words are in words_: there is at least one.
  virtual Status take_line() = 0;
  /// Handles a last line without newline. It is truncated if nothing proves that it is whole.
  virtual Status take_last_line() { return take_cut("the log ends in the middle of this line"); }
  /// Handles the end of a truncated log, of which `what` says how.
  Status take_cut(std::string_view what);
  /// What is read so far, such as "3 whole rows".
  [[nodiscard]] virtual std::string whole() const = 0;
  [[nodiscard]] virtual std::vector<Repair>& cut_repairs() = 0;

  const std::string& file_;
  int line_ = 0;  ///< From 1.
  std::string_view line_text_;
  std::vector<Token> words_;  ///< Words of the current line.

 private:
  bool accept_cut_;
  bool cut_reported_ = false;
};

}  // namespace rave::recording
