// SPDX-License-Identifier: Apache-2.0
#include "commands/gui.hpp"

#include <csignal>

#include "error_text.hpp"
#include "places.hpp"

namespace rave::cli {

int gui(const GuiCommand& options) {
  // Before the server has threads, so that none of them gets the signals.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  const auto file = record_file(options.file);
  if (!file) return complain(file.error());
  auto source = gui_server::open_recording(*file);
  if (!source) return complain(source.error());
  const auto server = serve_page(options.page, *std::move(source));
  if (!server) return complain(server.error());
  int signal = 0;
  sigwait(&signals, &signal);
  return kGood;
}

}  // namespace rave::cli
