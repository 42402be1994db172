// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/config/experiment_file.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::experiment {

/// Makes the digests of conditions; reads each program and plug-in once. One thread.
class InputDigest {
 public:
  /// `program`: the executable `rave`. Borrows the catalogue.
  InputDigest(std::filesystem::path program, plugin::Catalogue& catalogue)
      : program_(std::move(program)), catalogue_(catalogue) {}

  /// 16 hexadecimal digits. Errors: those of rave::read_file().
  [[nodiscard]] Result<std::string> of(config::ExpandedScenario scenario,
                                       const sim::EngineSpec& built,
                                       const config::ExperimentFile& experiment);

 private:
  [[nodiscard]] Result<std::uint64_t> content(const std::filesystem::path& file);
  [[nodiscard]] Status add_plugins(const sim::EngineSpec& built, std::string& text);

  std::filesystem::path program_;
  plugin::Catalogue& catalogue_;
  std::map<std::string, std::uint64_t> contents_;  // by path
  std::map<std::string, std::string> plugins_;     // by driver name: the lines that it adds
};

}  // namespace rave::experiment
