// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "rave/base/descriptor.hpp"

namespace rave {

/// Takes this number of bytes of the disk that has the folder, in a file without a name: they are
/// free again when the descriptor is closed, also by the death of the process. None if the disk has
/// less room, or the file system has no such files.
[[nodiscard]] Descriptor take_disk_room(const std::filesystem::path& folder,
                                        std::size_t bytes) noexcept;

}  // namespace rave
