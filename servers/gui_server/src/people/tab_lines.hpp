// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::gui_server {

/// A line of columns that are separated by tabs.
struct TabLine {
  std::vector<std::string_view> columns;  ///< At least one; parts of the text that was read.
  SourceLocation where;

  [[nodiscard]] std::string_view operator[](std::size_t column) const { return columns[column]; }
  /// Error kParse: it has another number of columns.
  [[nodiscard]] Status has(std::size_t count) const;
  /// An error of this line: kParse.
  template <class... Args>
  [[nodiscard]] tl::unexpected<Error> wrong(fmt::format_string<Args...> format,
                                            Args&&... args) const {
    return fail_at(where, ErrorCode::kParse, format, std::forward<Args>(args)...);
  }
};

/// The lines after the first, which must be `first`. `content` is what such a file has, as messages
/// say it. The text must outlive the result. Error kParse: another first line.
[[nodiscard]] Result<std::vector<TabLine>> tab_lines(std::string_view text,
                                                     std::string_view file_name,
                                                     std::string_view first,
                                                     std::string_view content);

}  // namespace rave::gui_server
