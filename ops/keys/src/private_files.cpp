// SPDX-License-Identifier: Apache-2.0
#include "private_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>

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
