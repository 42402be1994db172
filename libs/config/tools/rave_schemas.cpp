// SPDX-License-Identifier: Apache-2.0
// Writes the JSON Schemas of the configuration files. Usage: rave-schemas OUTPUT_DIR
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/config/experiment_file.hpp"
#include "rave/config/robot_file.hpp"
#include "rave/config/scenario_file.hpp"
#include "rave/config/world_file.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: rave-schemas OUTPUT_DIR\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::error_code ignored;  // an error shows when the first file is written
  std::filesystem::create_directories(folder, ignored);
  const std::pair<const char*, std::string> schemas[] = {
      {"robot", rave::config::robot_schema()},
      {"world", rave::config::world_schema()},
      {"scenario", rave::config::scenario_schema()},
      {"experiment", rave::config::experiment_schema()},
  };
  for (const auto& [name, text] : schemas) {
    const auto path = folder / (std::string(name) + ".schema.json");
    if (const auto written = rave::write_file_atomically(path, text); !written) {
      std::fprintf(stderr, "rave-schemas: %s\n", written.error().text().c_str());
      return 1;
    }
  }
  return 0;
}
