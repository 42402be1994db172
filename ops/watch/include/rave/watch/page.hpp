// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rave/watch/run_view.hpp"

namespace rave::watch {

struct PageOptions {
  std::size_t width = 80;  ///< Columns of the terminal.
  std::size_t height = 0;  ///< Lines; 0: as many as are needed.
  bool colour = false;     ///< Escape codes for colours are welcome.
  std::string keys{};      ///< What the last line says of keys; empty: nothing.
};

/// A run as lines of text, none wider than the page; what does not fit is left out: columns by
/// their weight, then rows, of which it says how many. UTF-8; control characters of names are
/// dropped, so no name can move the cursor. A line has no newline at its end.
[[nodiscard]] std::vector<std::string> render_page(const RunView& view, const PageOptions& options);

}  // namespace rave::watch
