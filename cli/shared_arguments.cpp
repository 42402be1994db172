// SPDX-License-Identifier: Apache-2.0
#include "shared_arguments.hpp"

namespace rave::cli {

void add_plugins(CLI::App& app, std::vector<std::string>& folders) {
  add_values(app, "--plugins", folders,
             "Folder with more plug-ins; may be given several times and wins over "
             "RAVE_PLUGIN_PATH and the built-in ones",
             "DIR");
}

void add_scenario(CLI::App& app, std::string& scenario) {
  add_word(app, "scenario", scenario, "A file, a folder with scenario.yaml, or a name", "SCENARIO");
}

void add_record(CLI::App& app, std::string& file) {
  add_word(app, "file", file, "A run.mcap, or the folder of a run", "FILE");
}

}  // namespace rave::cli
