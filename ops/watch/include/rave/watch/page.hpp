// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rave/watch/run_view.hpp"

namespace rave::watch {

struct PageOptions {
  std::size_t width = 80;  ///< Columns of the terminal.
  std::size_t height = 0;  ///< Number of lines; 0: no limit.
  bool colour = false;     ///< Whether to use escape codes for colours.
  std::string keys{};      ///< Key help for the last line; empty: none.
};

/// The view of a run as lines of text, not wider than the page. If it does not fit, columns are
/// omitted by importance, then rows, whose number is shown. UTF-8; control characters in names are
/// removed, so that no name can move the cursor. Lines have no newline.
[[nodiscard]] std::vector<std::string> render_page(const RunView& view, const PageOptions& options);

}  // namespace rave::watch
