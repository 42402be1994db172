// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace rave::cli {

/// `rave gui`.
struct GuiCommand {
  std::string file;  ///< A recording, or the folder of a run.
  std::uint16_t port = 8080;
  std::string page;  ///< Folder of the built page; empty: that of the installation.
  bool no_open = false;
};

/// Serves the page until SIGINT or SIGTERM. Returns 0, or 2 on bad input.
[[nodiscard]] int gui(const GuiCommand& options);

}  // namespace rave::cli
