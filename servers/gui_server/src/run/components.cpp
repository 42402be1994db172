// SPDX-License-Identifier: Apache-2.0
#include "run/components.hpp"

#include <fmt/format.h>

#include "rave/base/file.hpp"
#include "rave/base/plain_name.hpp"

namespace rave::gui_server {
namespace {

// Components are read again for each page, on the thread of the server: large ones would hold it
// up.
constexpr std::size_t kMostComponentBytes = std::size_t{1} << 20U;

/// As it stands in an address: letters that need no escape.
std::string plain_name(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    if (!is_plain(c, "-_")) c = '_';
  }
  return name;
}

PageComponent component_of(const config::GuiComponentFile& file) {
  PageComponent component;
  component.file = file.module.value;
  component.name = plain_name(component.file);
  for (const config::GuiRole role : file.roles) {
    component.roles.insert(role == config::GuiRole::kCommander ? Role::kCommander
                                                               : Role::kObserver);
  }
  return component;
}

bool is_there(const PageComponent& component) {
  std::error_code error;
  return std::filesystem::is_regular_file(component.file, error);
}

}  // namespace

Result<std::vector<PageComponent>> components_of(const config::GuiFile& gui) {
  RAVE_TRY(config::find_components(gui));
  std::vector<PageComponent> components;
  for (const config::GuiComponentFile& file : gui.components) {
    components.push_back(component_of(file));
  }
  return components;
}

std::vector<PageComponent> components_left(const config::GuiFile& gui) {
  std::vector<PageComponent> components;
  for (const config::GuiComponentFile& file : gui.components) {
    components.push_back(component_of(file));
    // A recording may be shown on a machine without the files of its scenario.
    if (!is_there(components.back())) components.pop_back();
  }
  return components;
}

std::string component_path(std::size_t number, const PageComponent& component) {
  return fmt::format("components/{}/{}.js", number, component.name);
}

const PageComponent* component_at(const std::vector<PageComponent>& components,
                                  std::string_view path) {
  for (std::size_t i = 0; i < components.size(); ++i) {
    // Compared with the known paths, so that no path from outside ever becomes a name of a file.
    if (path == "/" + component_path(i, components[i])) return &components[i];
  }
  return nullptr;
}

Result<std::string> read_component(const PageComponent& component) {
  return read_file(component.file, kMostComponentBytes);
}

}  // namespace rave::gui_server
