// SPDX-License-Identifier: Apache-2.0
#include "rave/config/scenario_file.hpp"

#include <filesystem>

#include "scenario_fields.hpp"

namespace rave::config {

Result<ScenarioFile> read_scenario_text(std::string_view text, std::string_view file_name) {
  return read_text<ScenarioFile>(text, file_name, prepare_robots);
}

Result<GuiFile> read_gui_text(std::string_view text, std::string_view file_name) {
  RAVE_TRY_ASSIGN(GuiFile gui, read_text<GuiFile>(text, file_name));
  if (!gui.file) return gui;
  return fail_at(
      gui.file->where, ErrorCode::kParse,
      "`file`: expected `rights`, `relay` and `components` in this file, not another file");
}

Status find_components(const GuiFile& gui) {
  for (const GuiComponentFile& component : gui.components) {
    std::error_code error;
    if (std::filesystem::is_regular_file(*component.module, error)) continue;
    return fail_at(component.module.where, ErrorCode::kNotFound,
                   "`module`: the component `{}` of the page is not a file", *component.module);
  }
  return {};
}

}  // namespace rave::config
