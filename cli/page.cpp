// SPDX-License-Identifier: Apache-2.0
#include "page.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/control/folder.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::cli {
namespace {

bool is_set(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

/// Whether there is a desktop here, in front of the user.
bool has_desktop() {
  return !is_set("SSH_CONNECTION") && (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"));
}

/// Where a browser can read a file of this user. Browsers of snaps see neither hidden folders nor
/// those for temporary files.
Result<std::filesystem::path> folder_for_browsers() {
  std::error_code ignored;
  const char* const home = std::getenv("HOME");
  if (is_set("HOME") && std::filesystem::exists("/snap", ignored)) return home;
  return control::socket_folder();
}

/// Opens the page where there is a desktop; elsewhere only the link is printed. The link itself is
/// not on the command line of the browser, which every user of this machine can read.
void open_browser(gui_server::GuiServer& server) {
  if (!has_desktop()) return;
  const auto folder = folder_for_browsers();
  if (!folder) return;
  const auto file = server.entry_file(*folder);
  // What a shell does not leave alone within quotes. The link was told; nothing is lost.
  if (!file || file->string().find('\'') != std::string::npos) return;
  const std::string command = fmt::format("xdg-open '{}' >/dev/null 2>&1 &", file->string());
  if (std::system(command.c_str()) != 0) return;
}

/// The name of this machine, for a command that is typed on another one.
std::string machine() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "THIS_MACHINE";
  return name.data();
}

std::string how_to_reach(const std::string& link, const std::string& foxglove, std::uint16_t port,
                         bool loopback) {
  std::string text = fmt::format("open  {}\n", link);
  if (!foxglove.empty()) text += fmt::format("foxglove  {}\n", foxglove);
  if (!has_desktop() && loopback) {
    text +=
        fmt::format("from your machine, first:  ssh -L {0}:127.0.0.1:{0} {1}\n", port, machine());
  }
  return text + "Ctrl-C ends\n";
}

}  // namespace

namespace {

void tell_notes(const gui_server::Source& source) {
  for (const std::string& note : source.about().notes) {
    put_note(terminal_of(stderr).yellow("note:"), note);
  }
}

}  // namespace

Result<std::unique_ptr<gui_server::GuiServer>> serve_page(
    const PageOptions& options, std::shared_ptr<gui_server::Source> source) {
  if (source) tell_notes(*source);
  PageOptions whole = options;
  if (whole.page.empty()) whole.page = share_folder() / "web";
  if (whole.accounts.empty() && whole.listen != gui_server::GuiOptions().listen) {
    whole.accounts = gui_server::Accounts::usual_folder();
  }
  RAVE_TRY_ASSIGN(auto server, gui_server::GuiServer::start(whole, std::move(source)));
  const std::string link = server->entry();
  const bool loopback = whole.listen == gui_server::GuiOptions().listen;
  put(stdout, how_to_reach(link, server->foxglove_address(), server->port(), loopback));
  std::fflush(stdout);
  if (!options.no_open) open_browser(*server);
  return server;
}

namespace {

Result<std::shared_ptr<gui_server::Source>> recording_of(const std::filesystem::path& folder) {
  RAVE_TRY_ASSIGN(const auto file, record_file(folder.string()));
  return gui_server::open_recording(file);
}

}  // namespace

void replay_on_page(gui_server::GuiServer& page, bool quiet, const std::filesystem::path& folder,
                    const runtime::RunControl& control) {
  if (control.stopping()) return;
  auto source = recording_of(folder);
  if (!quiet) {
    put(stdout, source
                    ? "the page shows the recording; press Ctrl-C to quit\n"
                    : fmt::format("the page cannot show the recording: {}; press Ctrl-C to quit\n",
                                  source.error().text()));
  }
  if (source) {
    tell_notes(**source);
    page.show(*std::move(source));
  }
  std::fflush(stdout);
  while (!control.stopping()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace rave::cli
