// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/gui_file.hpp"
#include "rave/gui_server/source.hpp"

// Panels that a scenario brings along. The page loads them as modules of its own origin.
namespace rave::gui_server {

/// Error: kNotFound, a file that is not there.
[[nodiscard]] Result<std::vector<PageComponent>> components_of(const config::GuiFile& gui);

/// The components of a recorded run whose files are still there. A recording can be older than its
/// files, or come from another machine, and must open all the same.
[[nodiscard]] std::vector<PageComponent> components_left(const config::GuiFile& gui);

/// Where the page finds a component, relative to the page: `components/0/heat_map.js`.
[[nodiscard]] std::string component_path(std::size_t number, const PageComponent& component);

/// The component of a path of a request, with its leading slash; null: there is none.
[[nodiscard]] const PageComponent* component_at(const std::vector<PageComponent>& components,
                                                std::string_view path);

/// Read at each request, so that an author sees a change after a reload. Errors: kIo, kNotFound,
/// kInvalidArgument (more than 1 MiB).
[[nodiscard]] Result<std::string> read_component(const PageComponent& component);

}  // namespace rave::gui_server
