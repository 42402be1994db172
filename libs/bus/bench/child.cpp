// SPDX-License-Identifier: Apache-2.0
#include "child.hpp"

#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

extern char** environ;

namespace rave::bus::bench {

Child start(std::vector<std::string> words) {
  words.insert(words.begin(), "/proc/self/exe");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) std::exit(1);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addclose(&actions, ends[0]);
  Child child;
  ::posix_spawn(&child.process, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  child.output = ::fdopen(ends[0], "r");
  return child;
}

double number_from(const Child& child) {
  double value = 0;
  return std::fscanf(child.output, "%lf", &value) == 1 ? value : -1;
}

std::unique_ptr<Bus> join(const std::string& run, const char* name, int max_processes) {
  BusConfig config;
  config.participant = name;
  config.run = *RunId::parse(run);
  config.tag = "bench-" + run;
  config.domain = 77;
  config.max_processes = max_processes;
  // To try out what settings of Cyclone DDS bring.
  if (const char* const settings = std::getenv("CYCLONEDDS_URI")) {
    config.cyclone_settings = settings;
  }
  auto bus = Bus::open(config);
  if (!bus) {
    std::fprintf(stderr, "%s\n", bus.error().text().c_str());
    std::exit(1);
  }
  return *std::move(bus);
}

}  // namespace rave::bus::bench
