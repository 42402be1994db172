// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_decoder.hpp"

#include <utility>

#include "scip_laser/scip_code.hpp"

namespace rave::scip {
namespace {

/// Removes the first line from `text`, which must end in a newline, and returns it.
std::string_view cut_line(std::string_view& text) noexcept {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line;
}

/// Whether lines of the reply end in a semicolon that the checksum excludes.
bool has_semicolons(std::string_view echo) noexcept {
  const std::string_view command = echo.substr(0, 2);
  return command == "VV" || command == "PP" || command == "II";
}

/// The line without its checksum; empty if that is wrong.
std::string_view checked(std::string_view line) noexcept {
  if (line.size() < 2) return {};
  const std::string_view text = line.substr(0, line.size() - 1);
  return checksum(text) == line.back() ? text : std::string_view();
}

}  // namespace

void ScipDecoder::reset() noexcept {
  text_.clear();
  line_length_ = 0;
  skipping_ = false;
  given_out_ = false;
}

// An empty line ends each reply, and no other line is empty. That is what the decoder synchronises
// to: after an error it skips until the next empty line.
const Reply* ScipDecoder::push(char byte) {
  if (std::exchange(given_out_, false)) text_.clear();
  if (byte != '\n') {
    ++line_length_;
    if (skipping_) return nullptr;
    text_.push_back(byte);
    // Bounds the memory for a device that sends no newline, or another protocol.
    if (line_length_ > kMaxLine || text_.size() > kMaxReply) {
      ++counts_.malformed;
      skipping_ = true;
      text_.clear();
    }
    return nullptr;
  }
  if (std::exchange(line_length_, 0) > 0) {
    if (!skipping_) text_.push_back(byte);
    return nullptr;
  }
  const bool skipped = std::exchange(skipping_, false);
  if (skipped || text_.empty()) return nullptr;
  given_out_ = true;
  return complete();
}

const Reply* ScipDecoder::complete() {
  std::string_view rest = text_;
  reply_.lines.clear();
  reply_.echo = cut_line(rest);
  if (rest.empty()) {
    ++counts_.malformed;
    return nullptr;
  }
  const std::string_view status = cut_line(rest);
  // The answer to SCIP2.0 has a status of one character without a checksum.
  if (status.size() == 1 && reply_.echo.starts_with("SCIP")) {
    reply_.status = status;
  } else if (status.size() != 3) {
    ++counts_.malformed;
    return nullptr;
  } else {
    reply_.status = checked(status);
    if (reply_.status.empty()) {
      ++counts_.bad_checksum;
      return nullptr;
    }
  }
  const bool semicolons = has_semicolons(reply_.echo);
  while (!rest.empty()) {
    if (!take_line(cut_line(rest), semicolons)) return nullptr;
  }
  ++counts_.replies;
  return &reply_;
}

bool ScipDecoder::take_line(std::string_view line, bool semicolon) {
  if (line.size() < (semicolon ? 3U : 2U)) {
    ++counts_.malformed;
    return false;
  }
  std::string_view text = line.substr(0, line.size() - 1);
  if (semicolon) {
    if (text.back() != ';') {
      ++counts_.malformed;
      return false;
    }
    text.remove_suffix(1);
  }
  if (checksum(text) != line.back()) {
    ++counts_.bad_checksum;
    return false;
  }
  reply_.lines.push_back(text);
  return true;
}

}  // namespace rave::scip
