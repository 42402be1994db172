// SPDX-License-Identifier: Apache-2.0
#include "commands/gui.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::cli {
namespace {

bool is_set(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

/// Opens the page where there is a desktop; over SSH and without a display only the link is told.
void open_browser(const std::string& link) {
  if (is_set("SSH_CONNECTION") || (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))) return;
  // The link has only characters that a shell leaves alone within quotes.
  const std::string command = fmt::format("xdg-open '{}' >/dev/null 2>&1 &", link);
  if (std::system(command.c_str()) != 0) return;  // The link was told; nothing is lost.
}

std::string how_to_reach(const std::string& link, std::uint16_t port) {
  std::string text = fmt::format("open  {}\n", link);
  if (is_set("SSH_CONNECTION")) {
    text += fmt::format("from your machine, first:  ssh -L {0}:127.0.0.1:{0} THIS_MACHINE\n", port);
  }
  return text + "Ctrl-C ends\n";
}

}  // namespace

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
  gui_server::GuiOptions gui_options;
  gui_options.page =
      options.page.empty() ? share_folder() / "web" : std::filesystem::path(options.page);
  gui_options.port = options.port;
  const auto server = gui_server::GuiServer::start(gui_options, *std::move(source));
  if (!server) return complain(server.error());
  const std::string link = (*server)->entry();
  put(stdout, how_to_reach(link, (*server)->port()));
  if (!options.no_open) open_browser(link);
  int signal = 0;
  sigwait(&signals, &signal);
  return kGood;
}

}  // namespace rave::cli
