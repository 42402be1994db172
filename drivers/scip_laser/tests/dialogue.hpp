// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scip_laser/scip_decoder.hpp"

namespace rave::scip {

/// As the specification prints it, for lines made by hand in tests.
inline std::string with_sum(const std::string& text, bool semicolon = false) {
  unsigned sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  return text + (semicolon ? ";" : "") + static_cast<char>((sum & 0x3fU) + 0x30U) + "\n";
}

inline std::string encoded(unsigned value, int characters) {
  std::string text;
  for (int i = characters - 1; i >= 0; --i) {
    text += static_cast<char>(((value >> (6 * i)) & 0x3fU) + 0x30U);
  }
  return text;
}

/// One scan as the device sends it.
inline std::string scan_text(const std::string& echo, const std::string& status, unsigned timer_ms,
                             const std::vector<unsigned>& ranges_mm, int characters) {
  std::string text = echo + "\n" + with_sum(status) + with_sum(encoded(timer_ms, 4));
  std::string data;
  for (const unsigned mm : ranges_mm) data += encoded(mm, characters);
  for (std::size_t i = 0; i < data.size(); i += 64) text += with_sum(data.substr(i, 64));
  return text + "\n";
}

/// A reply that outlives the decoder.
struct Kept {
  std::string echo;
  std::string status;
  std::vector<std::string> lines;
  friend bool operator==(const Kept&, const Kept&) = default;
};

inline std::vector<Kept> feed(ScipDecoder& decoder, std::string_view bytes) {
  std::vector<Kept> replies;
  for (const char byte : bytes) {
    const Reply* reply = decoder.push(byte);
    if (reply == nullptr) continue;
    replies.push_back({std::string(reply->echo),
                       std::string(reply->status),
                       {reply->lines.begin(), reply->lines.end()}});
  }
  return replies;
}

}  // namespace rave::scip
