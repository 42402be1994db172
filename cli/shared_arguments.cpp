// SPDX-License-Identifier: Apache-2.0
#include "shared_arguments.hpp"

#include <fmt/format.h>

#include "bus_options.hpp"

namespace rave::cli {

void add_processes(CLI::App& app, std::optional<int>& processes, const char* what, int least) {
  const auto check = [least](const std::string& word) -> std::string {
    const int most = static_cast<int>(kMostHosts);
    if (CLI::Range(least, most)(word).empty()) return {};
    return fmt::format(
        "expected {} to {}: a machine has room for so many hosts in a DDS domain; give each more "
        "robots",
        least, most);
  };
  add_value(app, "--processes", processes, what, "N")->check(check);
}

void add_plugins(CLI::App& app, std::vector<std::string>& folders) {
  add_values(app, "--plugins", folders,
             "Folder with more plug-ins; may be given several times and wins over "
             "RAVE_PLUGIN_PATH and the built-in ones",
             "DIR");
}

void add_scenario(CLI::App& app, std::string& scenario) {
  add_word(app, "scenario", scenario, "A file, a folder with scenario.yaml, or a name", "SCENARIO");
}

void add_page_options(CLI::App& app, PageOptions& page) {
  add_value(app, "--port", page.port, "Port; a busy one means the next [8080]", "PORT");
  add_value(app, "--page", page.page, "Folder of the built page [that of this installation]",
            "DIR");
  app.add_flag("--no-open", page.no_open, "Print the link, but open no browser");
  add_value(app, "--listen", page.listen, "Address; another one needs TLS and accounts [127.0.0.1]",
            "ADDRESS");
  add_value(app, "--certificate", page.certificate, "For TLS, as `rave keys web` makes it", "FILE");
  add_value(app, "--key", page.key, "The private key of the certificate", "FILE");
  add_value(app, "--line-key", page.line_key,
            "The key that hosts with --web-key believe: FILE of `rave keys line FILE`", "FILE");
  add_value(app, "--accounts", page.accounts, "Folder of accounts: see `rave people`", "DIR");
}

void add_line_options(CLI::App& app, LineWish& line) {
  add_value(app, "--web", line.web,
            "Let pages reach the host without the GUI Server, at this place [127.0.0.1, any port]",
            "ADDRESS:PORT")
      ->expected(0, 1)
      ->default_str("");
  add_value(app, "--web-key", line.web_key,
            "The public key of the GUI Server, FILE.pub of `rave keys line FILE`", "FILE");
  add_value(app, "--web-certificate", line.certificate, "For TLS, as `rave keys web` makes it",
            "FILE");
  add_value(app, "--web-certificate-key", line.key, "The private key of that certificate", "FILE");
}

void add_record(CLI::App& app, std::string& file) {
  add_word(app, "file", file, "A run.mcap, or the folder of a run", "FILE");
}

}  // namespace rave::cli
