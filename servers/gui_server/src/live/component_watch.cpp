// SPDX-License-Identifier: Apache-2.0
#include "live/component_watch.hpp"

#include <fmt/format.h>

#include "rave/config/gui_of_scenario.hpp"

namespace rave::gui_server {

ComponentWatch::ComponentWatch(std::filesystem::path scenario) : scenario_(std::move(scenario)) {
  if (scenario_.empty()) return;
  files_.push_back(scenario_);
  if (const auto read = config::read_gui_of(scenario_)) files_ = read->files;
  stamp_ = stamp();
}

std::string ComponentWatch::stamp() const {
  std::string all;
  for (const auto& file : files_) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error).time_since_epoch().count();
    const auto size = std::filesystem::file_size(file, error);
    all += fmt::format("{} {} {}\n", time, size, error.value());
  }
  return all;
}

std::optional<Result<std::vector<PageComponent>>> ComponentWatch::look() {
  if (scenario_.empty()) return std::nullopt;
  // A module that was missing may be there by now, which no stamp says.
  if (told_.empty() && stamp() == stamp_) return std::nullopt;
  const auto read = config::read_gui_of(scenario_);
  auto components = read ? components_of(read->gui) : tl::unexpected(read.error());
  if (read) files_ = read->files;
  stamp_ = stamp();
  const std::string why = components ? std::string() : components.error().text();
  const bool again = !components && why == told_;
  told_ = why;
  if (again) return std::nullopt;
  return components;
}

}  // namespace rave::gui_server
