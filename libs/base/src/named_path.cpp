// SPDX-License-Identifier: Apache-2.0
#include "rave/base/named_path.hpp"

#include <cstdlib>

namespace rave {

std::filesystem::path named_path(const std::filesystem::path& folder, std::string_view name) {
  const char* const home = std::getenv("HOME");
  const bool of_home = name == "~" || name.starts_with("~/");
  // operator/ ignores what stands before an absolute path.
  if (!of_home || home == nullptr || *home == '\0') return folder / name;
  // Without the slash: `/x` behind a folder would be an absolute path.
  return name.size() <= 2 ? std::filesystem::path(home)
                          : std::filesystem::path(home) / name.substr(2);
}

}  // namespace rave
