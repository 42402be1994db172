// SPDX-License-Identifier: Apache-2.0
#include "lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

namespace rave::experiment {

Result<Descriptor> lock_file(const std::filesystem::path& path, bool shared) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (file && ::flock(file.get(), (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return file;
  if (file && errno == EWOULDBLOCK) {
    return fail(ErrorCode::kState,
                "another sweep is at work in `{}`; wait for its end, or name "
                "another folder by --output",
                path.parent_path().string());
  }
  return fail(ErrorCode::kIo, "cannot lock `{}`: {}", path.string(),
              std::system_category().message(errno));
}

}  // namespace rave::experiment
