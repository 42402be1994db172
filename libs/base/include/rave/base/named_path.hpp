// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace rave {

/// The path that a file names: relative to the folder of that file, absolute, or with `~` for the
/// home folder of the user, as a shell takes it (`~` alone or `~/...`; not that of another user).
[[nodiscard]] std::filesystem::path named_path(const std::filesystem::path& folder,
                                               std::string_view name);

}  // namespace rave
