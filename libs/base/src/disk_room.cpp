// SPDX-License-Identifier: Apache-2.0
#include "rave/base/disk_room.hpp"

#include <fcntl.h>

namespace rave {

Descriptor take_disk_room(const std::filesystem::path& folder, std::size_t bytes) noexcept {
  Descriptor file(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  // Where the file system cannot reserve blocks, this writes them.
  if (file && ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes)) != 0) file.reset();
  return file;
}

}  // namespace rave
