// SPDX-License-Identifier: Apache-2.0
// Finds the power operator, whose results differ from processor to processor, outside of texts and
// comments.
#include "lua.hpp"

namespace rave::script::lua {
namespace {

/// Goes through a source character by character.
class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  Place find() {
    while (at_ < source_.size()) {
      const char c = source_[at_];
      if (c == '^') return place_;
      if (c == '"' || c == '\'') {
        skip_quoted(c);
      } else if (c == '-' && peek(1) == '-') {
        advance(2);
        if (!skip_long()) skip_line();
      } else if (c != '[' || !skip_long()) {
        advance(1);
      }
    }
    return {};
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead) const noexcept {
    return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0';
  }
  void advance(std::size_t count) {
    for (; count > 0 && at_ < source_.size(); --count, ++at_) {
      if (source_[at_] == '\n') {
        ++place_.line;
        place_.column = 1;
      } else {
        ++place_.column;
      }
    }
  }
  void skip_line() {
    while (at_ < source_.size() && source_[at_] != '\n') advance(1);
  }
  void skip_quoted(char quote) {
    advance(1);
    while (at_ < source_.size() && source_[at_] != quote && source_[at_] != '\n') {
      advance(source_[at_] == '\\' ? 2 : 1);
    }
    advance(1);
  }
  /// `[[…]]` or `[==[…]==]`, if one begins here.
  bool skip_long() {
    if (peek(0) != '[') return false;
    std::size_t equals = 0;
    while (peek(1 + equals) == '=') ++equals;
    if (peek(1 + equals) != '[') return false;
    const std::string close = "]" + std::string(equals, '=') + "]";
    const std::size_t end = source_.find(close, at_ + equals + 2);
    advance(end == std::string_view::npos ? source_.size() - at_ : end + close.size() - at_);
    return true;
  }

  std::string_view source_;
  std::size_t at_ = 0;
  Place place_{1, 1};
};

}  // namespace

Place find_power(std::string_view source) { return Scanner(source).find(); }

}  // namespace rave::script::lua
