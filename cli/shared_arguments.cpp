// SPDX-License-Identifier: Apache-2.0
#include "shared_arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string_view>
#include <utility>

#include "commands/run.hpp"
#include "rave/base/names.hpp"
#include "rave/base/number.hpp"

namespace rave::cli {

CLI::Validator number_in(double least, double most) {
  const auto check = [least, most](const std::string& word) -> std::string {
    const auto number = number_of<double>(word);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("found `{}`, expected a number from {} to {}", word, least, most);
  };
  return {check, fmt::format("FLOAT in [{} - {}]", least, most)};
}

CLI::Validator whole_number_in(std::uint64_t least, std::uint64_t most) {
  const auto check = [least, most](const std::string& word) -> std::string {
    // CLI11 would wrap negative whole numbers round.
    const auto number = number_of<std::uint64_t>(word);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("found `{}`, expected a whole number from {} to {}", word, least, most);
  };
  return {check, most == UINT64_MAX ? "" : fmt::format("INT in [{} - {}]", least, most)};
}

CLI::Validator one_of(std::vector<std::string> words) {
  const auto check = [words = std::move(words)](const std::string& word) -> std::string {
    if (std::ranges::find(words, word) != words.end()) return {};
    const std::vector<std::string_view> views(words.begin(), words.end());
    return fmt::format("found `{}`, expected one of {}{}", word, fmt::join(words, ", "),
                       nearest_name(word, views).empty() ? "" : suggestion(word, views));
  };
  return {check, ""};
}

void add_whole_number(CLI::App& app, const char* name, std::optional<std::uint64_t>& value,
                      const char* what) {
  add_value(app, name, value, what, "N")->check(whole_number_in(0, UINT64_MAX));
}

void add_processes(CLI::App& app, std::optional<int>& processes, const char* what, int least) {
  const auto check = [least](const std::string& word) -> std::string {
    const int most = static_cast<int>(kMostHosts);
    if (whole_number_in(static_cast<std::uint64_t>(least), kMostHosts)(word).empty()) return {};
    return fmt::format(
        "found `{}`, expected {} to {}, the number of hosts that fit into one DDS domain on a "
        "machine; give each host more robots",
        word, least, most);
  };
  add_value(app, "--processes", processes, what, "N")->check(check);
}

void add_plugins(CLI::App& app, std::vector<std::string>& folders) {
  add_values(app, "--plugins", folders,
             "Folder with more plug-ins, searched before RAVE_PLUGIN_PATH and the built-in ones; "
             "repeatable",
             "DIR");
}

void add_settings(CLI::App& app, std::vector<std::string>& settings) {
  add_values(app, "--set", settings,
             "Value for a key of the scenario, such as robots.prey.pose.x_m=1; items of lists by "
             "name or from 0; repeatable",
             "KEY=VALUE");
}

void add_scenario(CLI::App& app, std::string& scenario) {
  add_word(app, "scenario", scenario, "Scenario: a file, a folder with scenario.yaml, or a name",
           "SCENARIO");
}

void add_page_options(CLI::App& app, PageOptions& page) {
  add_value(app, "--port", page.port, "Port of the page; if it is in use, the next free one [8080]",
            "PORT");
  add_value(app, "--page", page.page, "Folder of the built page [the installed one]", "DIR");
  app.add_flag("--no-open", page.no_open, "Print the link, do not open a browser");
  add_value(app, "--listen", page.listen,
            "Address of the page; others than the default need TLS and accounts [127.0.0.1]",
            "ADDRESS");
  add_value(app, "--certificate", page.certificate, "Certificate for TLS, made by `rave keys web`",
            "FILE");
  add_value(app, "--key", page.key, "Private key of the certificate", "FILE");
  add_value(app, "--line-key", page.line_key,
            "Signing key of direct lines, made by `rave keys line FILE`", "FILE");
  add_value(app, "--accounts", page.accounts, "Folder of accounts, made by `rave people`", "DIR");
  auto* const foxglove =
      app.add_flag("--foxglove", page.foxglove, "Let Foxglove and Lichtblick connect, read-only");
  add_values(app, "--foxglove-origin", page.foxglove_origins,
             "Origin of a page that may connect to Foxglove's endpoint, such as "
             "https://app.foxglove.dev, or file:// for "
             "a desktop program; repeatable",
             "ORIGIN")
      ->needs(foxglove);
}

void add_line_options(CLI::App& app, launch::LineArguments& line) {
  add_value(app, "--web", line.web,
            "Address of the direct line, on which pages reach this host without the GUI Server "
            "[127.0.0.1, any port]",
            "ADDRESS:PORT")
      ->expected(0, 1)
      ->default_str("");
  add_value(app, "--web-key", line.web_key,
            "Public key of the GUI Server: FILE.pub of `rave keys line FILE` [line.pub in the "
            "folder of --security]",
            "FILE");
  add_value(app, "--web-certificate", line.certificate,
            "Certificate for TLS, made by `rave keys web`", "FILE");
  add_value(app, "--web-certificate-key", line.key, "Private key of the certificate", "FILE");
}

void add_record(CLI::App& app, std::string& file) {
  add_word(app, "file", file, "Recording (run.mcap), or folder of a run", "FILE");
}

void add_run_options(CLI::App& app, RunCommand& c) {
  add_value(app, "--output", c.output, "Folder for the results [runs/<time>-<scenario>]", "DIR");
  app.add_flag("--replace", c.replace, "Remove the results of an earlier run from that folder");
  add_settings(app, c.set);
  add_whole_number(app, "--seed", c.seed, "Random seed (overrides the scenario)");
  add_threads(app, c.threads);
  add_value(app, "--duration", c.duration_s, "Simulated time, in seconds (overrides the scenario)",
            "S")
      ->check(number_in(1e-4, 1e9));
  add_value(app, "--pace", c.pace,
            "Speed: max, realtime, or a factor such as 10x (overrides the scenario)", "PACE");
  app.add_flag("--no-picture", c.no_picture, "Do not draw picture.svg and picture.png");
  app.add_flag("--no-record", c.no_record, "Do not write run.mcap");
  app.add_flag("--arm", c.arm, "Arm all robots at the start: real robots may move immediately");
  app.add_flag("--quiet", c.quiet, "Print errors and problems only");
  // Not for people: a run of a sweep ends with the sweep, however that ends.
  app.add_option_function<pid_t>("--end-with-parent",
                                 [](const pid_t& parent) {
                                   ::prctl(PR_SET_PDEATHSIG, SIGKILL);
                                   if (::getppid() != parent) ::raise(SIGKILL);
                                 })
      ->group("");
  add_plugins(app, c.plugins);
}

void add_network_options(CLI::App& app, BusOptions& c) {
  add_value(app, "--domain", c.domain, "DDS domain of a run with several processes [0]", "N")
      ->check(whole_number_in(0, 230));
  add_value(app, "--interface", c.interface,
            "Network interface, by address or name [this machine only]", "ADDR");
  add_values(app, "--peer", c.peers,
             "Address of a machine with other processes of the run; repeatable", "ADDR");
  add_value(app, "--multicast", c.multicast,
            "Use of multicast: none, discovery (only to find processes) or data (for both) [none]",
            "USE");
  add_value(app, "--security", c.security,
            "Encrypt; folder with the certificates of this process, made by `rave keys`", "DIR");
  // Not for people: keeps tests on one machine apart, and lets a benchmark count what goes by DDS.
  app.add_option("--bus-tag", c.tag)->group("");
  app.add_flag("--dds-only", c.dds_only)->group("");
}

void add_bus_options(CLI::App& app, BusOptions& c) {
  add_value(app, "--run", c.run,
            "Name of the run, the same for all of its processes [name of the scenario]", "NAME");
  add_network_options(app, c);
}

}  // namespace rave::cli
