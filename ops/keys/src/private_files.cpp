// SPDX-License-Identifier: Apache-2.0
#include "private_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace rave::keys {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> refused(std::string_view what, const fs::path& path) {
  const int code = errno;
  return fail(code == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot {} `{}`: {}", what,
              path.string(), std::strerror(code));
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(file, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  // The set must be on the disk before it is moved to its place, or a power failure could leave
  // empty files under its name.
  return ::fsync(file) == 0;
}

}  // namespace

Result<ScratchFolder> ScratchFolder::inside(const fs::path& parent) {
  std::string name = parent / ".rave-keys-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) return refused("create a folder in", parent);
  return ScratchFolder(name);
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept : path_(std::move(other.path_)) {
  other.path_.clear();
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

Status make_private_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) return refused("create the folder", folder);
  return {};
}

Status write_private_file(const fs::path& path, std::string_view content) {
  // O_EXCL also refuses a link that another user has put there. The mode is set at creation, so
  // there is no moment in which others could read the key.
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return refused("create", path);
  const bool written = write_all(file, content);
  const int code = errno;
  const bool closed = ::close(file) == 0;
  if (!written) errno = code;
  if (!written || !closed) return refused("write", path);
  return {};
}

Status move_to_free_name(const fs::path& from, const fs::path& to) {
  int result = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE);
  // Not every file system supports renaming without replacement; a plain rename replaces at most an
  // empty folder.
  if (result != 0 && errno == EINVAL && !is_taken(to)) result = ::rename(from.c_str(), to.c_str());
  if (result == 0) return {};
  if (errno == EEXIST || errno == ENOTEMPTY || is_taken(to)) {
    return fail(ErrorCode::kInvalidArgument, "`{}` already exists; nothing was changed",
                to.string());
  }
  return refused("make", to);
}

bool is_taken(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

}  // namespace rave::keys
