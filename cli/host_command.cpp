// SPDX-License-Identifier: Apache-2.0
#include "host_command.hpp"

#include <fmt/format.h>

#include <vector>

#include "terminal.hpp"

namespace rave::cli {

std::string host_command(const RunCommand& options, const std::string& host,
                         const bus::RunId& run) {
  std::vector<std::string> words = {"rave", "robot", options.scenario, "--host", host};
  const auto add = [&words](const char* option, const auto& value) {
    if (value) words.insert(words.end(), {option, fmt::format("{}", *value)});
  };
  add("--seed", options.seed);
  add("--duration", options.duration_s);
  add("--processes", options.processes);
  for (const std::string& folder : options.plugins) {
    words.insert(words.end(), {"--plugins", folder});
  }
  for (const std::string& word : words_of(options.bus, run)) words.push_back(word);
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace rave::cli
