// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "shared_world.hpp"

namespace rave::cli_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// The crowd over two hosts.
class Hosts : public SharedWorld {
 protected:
  /// Starts a manager and the two hosts of `crowd`, which would take longer than any test.
  void start_crowd(const Words& more) {
    Words words = more;
    words.insert(words.end(), {"--duration", "100000"});
    start("env", "env", scenario_, words);
    start_host("one", scenario_, words);
    start_host("two", scenario_, words);
    wait_for_steps();
  }
  /// Until the record of a host shows that the run goes.
  void wait_for_steps() {
    for (const char* const host : {"one", "two"}) {
      wait_until([&] { return record_size(host) > 100'000; }, std::string(host) + " runs");
    }
  }
  [[nodiscard]] std::uintmax_t record_size(const std::string& host) const {
    std::error_code error;
    const auto size = fs::file_size(folder(host) + "/run.mcap", error);
    return error ? 0 : size;
  }
  void wait_for_more(const std::string& host) {
    const auto before = record_size(host);
    wait_until([&] { return record_size(host) > before + 100'000; }, host + " goes on");
  }
  /// The crowd with checks of what nobody but the world as a whole can tell; its file.
  [[nodiscard]] std::string checked_crowd() const {
    std::string path = crowd_with_policy("wait", 5);
    std::ofstream(path, std::ios::app)
        << "checks:\n"
           "  capture: {predator: left, prey: right, within_m: 0.05, before_s: 40}\n"
           "  touches: [{robots: [left], most: 1000000, least: 1}]\n";
    return path;
  }
  /// result.json without what is of the processes.
  [[nodiscard]] nlohmann::json result_of(const std::string& name) const {
    nlohmann::json json = result(name);
    json.erase("wall_s");
    json.erase("hosts");
    return json;
  }
  void write_policy(const std::string& policy, double timeout_s) {
    scenario_ = crowd_with_policy(policy, timeout_s);
  }

  std::string scenario_ = "crowd.yaml";
};

}  // namespace rave::cli_test
