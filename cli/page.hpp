// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rave/control/run_control.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::cli {

/// Where the page is served. Without `page` it is that of the installation; without `accounts` they
/// are the user's, if it listens elsewhere than on loopback.
struct PageOptions : gui_server::GuiOptions {
  bool no_open = false;
  std::string line_key;  ///< The file of the key that hosts believe; empty: none.
};

/// Serves the page, prints its link and opens it where there is a desktop. Without a source it
/// waits for one. Errors: those of GuiServer::start().
[[nodiscard]] Result<std::unique_ptr<gui_server::GuiServer>> serve_page(
    const PageOptions& options, std::shared_ptr<gui_server::Source> source = nullptr);

/// When a run is over, its page shows the recording in `folder` until this process is ended.
void replay_on_page(gui_server::GuiServer& page, bool quiet, const std::filesystem::path& folder,
                    const runtime::RunControl& control);

}  // namespace rave::cli
