// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "bus_options.hpp"
#include "page.hpp"
#include "rave/launch/host_line.hpp"

/// What the arguments of several subcommands have in common. All write to what they are given.
namespace rave::cli {

struct RunCommand;

/// A subcommand and its options.
template <class Options>
struct Subcommand {
  CLI::App& app;
  Options& options;  ///< Lives as long as `app`.
};

/// Adds a subcommand. When the command line names it, `act` with its options becomes `chosen`.
template <class Options>
Subcommand<Options> add_command(CLI::App& parent, Command& chosen, const char* name,
                                const char* what, Result<int> (*act)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = *parent.add_subcommand(name, what);
  app.callback([&chosen, act, options] { chosen = [act, options] { return act(*options); }; });
  return {app, *options};
}

/// A word or an option that may be missing. `type`: what help calls its value.
template <class T>
CLI::Option* add_value(CLI::App& app, const char* name, T& value, const char* what,
                       const char* type) {
  return app.add_option(name, value, what)->type_name(type);
}

/// The same, but it must be there.
template <class T>
CLI::Option* add_word(CLI::App& app, const char* name, T& value, const char* what,
                      const char* type) {
  return add_value(app, name, value, what, type)->required();
}

/// An option that may be repeated, with one value each time.
inline CLI::Option* add_values(CLI::App& app, const char* name, std::vector<std::string>& values,
                               const char* what, const char* type) {
  return add_value(app, name, values, what, type)->take_all()->allow_extra_args(false);
}

/// Check a word of the command line. Errors have the style of those in files: what was found, and
/// what was expected. Help shows the range of a number, unless that is the range of its type.
[[nodiscard]] CLI::Validator number_in(double least, double most);
[[nodiscard]] CLI::Validator whole_number_in(std::uint64_t least, std::uint64_t most);
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

/// An option whose value is a whole number from 0. CLI11 would wrap negative numbers round.
void add_whole_number(CLI::App& app, const char* name, std::optional<std::uint64_t>& value,
                      const char* what);

/// Of a number or an optional one.
template <class T>
void add_threads(CLI::App& app, T& threads,
                 const char* what = "Number of threads; the result does not depend on it") {
  add_value(app, "--threads", threads, what, "N")->check(whole_number_in(1, 1024));
}

/// Into how many processes the robots are shared: `least` to kMostHosts.
void add_processes(CLI::App& app, std::optional<int>& processes, const char* what, int least);

/// `--set`; see config::Settings.
void add_settings(CLI::App& app, std::vector<std::string>& settings);
/// Folders of plug-ins beside those that are found anyway.
void add_plugins(CLI::App& app, std::vector<std::string>& folders);

/// The scenario that a subcommand is about.
void add_scenario(CLI::App& app, std::string& scenario);

/// Where the page is served.
void add_page_options(CLI::App& app, PageOptions& page);

/// The direct line of a host.
void add_line_options(CLI::App& app, launch::LineArguments& line);

/// What all that run something have in common: output, seed, threads, time, pace and the like.
void add_run_options(CLI::App& app, RunCommand& c);

/// The options with which a process reaches others: domain, interface, peers, multicast,
/// certificates.
void add_network_options(CLI::App& app, BusOptions& c);

/// The same options and the name of the run.
void add_bus_options(CLI::App& app, BusOptions& c);

/// The record that a subcommand is about.
void add_record(CLI::App& app, std::string& file);

}  // namespace rave::cli
