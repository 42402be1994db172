// SPDX-License-Identifier: Apache-2.0
#include "host_command.hpp"

#include <fmt/format.h>

#include <vector>

#include "rave/process/shell_word.hpp"

namespace rave::launch {

std::string host_command(const RunSettings& settings, const std::string& host,
                         const bus::RunId& run) {
  std::vector<std::string> words = {"rave", "robot", settings.scenario, "--host", host};
  const auto add = [&words](const char* option, const auto& value) {
    if (value) words.insert(words.end(), {option, fmt::format("{}", *value)});
  };
  add("--seed", settings.seed);
  add("--duration", settings.duration_s);
  add("--processes", settings.processes);
  for (const std::string& setting : settings.set) words.insert(words.end(), {"--set", setting});
  for (const std::string& folder : settings.plugins) {
    words.insert(words.end(), {"--plugins", folder});
  }
  for (const std::string& word : bus::words_of(settings.bus, run)) words.push_back(word);
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + process::shell_word(word);
  return line;
}

}  // namespace rave::launch
