// SPDX-License-Identifier: Apache-2.0
#include "recording/tokens.hpp"

namespace rave::recording {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

std::vector<Token> split(std::string_view line) {
  std::vector<Token> tokens;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size()) return tokens;
    const std::size_t begin = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    tokens.push_back({line.substr(begin, at - begin), static_cast<int>(begin) + 1});
  }
}

std::string shown(std::string_view token) {
  std::string text(token.substr(0, 24));
  for (char& c : text) {
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  return token.size() > 24 ? text + "..." : text;
}

}  // namespace rave::recording
