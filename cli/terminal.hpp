// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace rave::cli {

/// Properties of the terminal behind a stream; with the defaults for a file or pipe, where text
/// stays plain.
struct Terminal {
  bool is_terminal = false;
  bool colour = false;      ///< Escape codes may be used: a terminal, and NO_COLOR is not set.
  std::size_t width = 80;   ///< Columns.
  std::size_t height = 24;  ///< Lines.

  [[nodiscard]] std::string bold(std::string_view text) const { return styled("1", text); }
  [[nodiscard]] std::string faint(std::string_view text) const { return styled("2", text); }
  [[nodiscard]] std::string red(std::string_view text) const { return styled("1;31", text); }
  [[nodiscard]] std::string yellow(std::string_view text) const { return styled("33", text); }
  [[nodiscard]] std::string green(std::string_view text) const { return styled("32", text); }

 private:
  [[nodiscard]] std::string styled(std::string_view code, std::string_view text) const;
};

/// Queries the operating system each time, because windows change their size.
[[nodiscard]] Terminal terminal_of(std::FILE* stream);

/// Writes the whole text to a stream; what cannot be written is lost.
void put(std::FILE* stream, std::string_view text);

/// Writes a line to standard error: a text behind its label, which may be coloured.
void put_note(std::string_view label, std::string_view text);

}  // namespace rave::cli
