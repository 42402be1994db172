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

/// Where the page is served.
struct PageOptions {
  std::uint16_t port = 8080;
  std::string page;  ///< Folder of the built page; empty: that of the installation.
  bool no_open = false;
  std::string listen = "127.0.0.1";
  std::string certificate;  ///< With `key`: TLS.
  std::string key;
  std::string line_key;   ///< The file of the key that hosts believe; empty: none.
  std::string accounts;   ///< Folder; empty: the user's, if it listens elsewhere than on loopback.
  bool foxglove = false;  ///< Foxglove may connect.
  std::vector<std::string> foxglove_origins;
};

/// Serves the page, prints its link and opens it where there is a desktop. Without a source it
/// waits for one. Errors: those of GuiServer::start().
[[nodiscard]] Result<std::unique_ptr<gui_server::GuiServer>> serve_page(
    const PageOptions& options, std::shared_ptr<gui_server::Source> source = nullptr);

/// When a run is over, its page shows the recording in `folder` until this process is ended.
void replay_on_page(gui_server::GuiServer& page, bool quiet, const std::filesystem::path& folder,
                    const runtime::RunControl& control);

}  // namespace rave::cli
