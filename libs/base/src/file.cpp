// SPDX-License-Identifier: Apache-2.0
#include "rave/base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "rave/base/descriptor.hpp"
#include "rave/base/regular_file.hpp"

namespace rave {
namespace {

tl::unexpected<Error> system_failure(const std::filesystem::path& path, std::string_view what) {
  const int code = errno;
  return fail(code == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot {} `{}`: {}", what,
              path.string(), std::strerror(code));
}

/// Creates a file, which `flags` may require to be new, and writes its content to the disk. Before
/// a move to another name: otherwise a power failure can leave that name with an empty file.
Status create_file(const std::filesystem::path& path, int flags, ::mode_t mode,
                   std::string_view content) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode));
  if (file.get() < 0) return system_failure(path, "create");
  while (!content.empty()) {
    const ssize_t count = ::write(file.get(), content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_failure(path, "write");
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fsync(file.get()) != 0 && errno != EINVAL) return system_failure(path, "flush");
  return {};
}

}  // namespace

Result<int> open_regular_file(const std::filesystem::path& path) {
  // O_NONBLOCK opens a pipe without waiting; it does not affect regular files.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) return system_failure(path, "open");
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) return system_failure(path, "inspect");
  if (S_ISREG(info.st_mode)) return file.release();
  return fail(ErrorCode::kIo, "cannot read `{}`: it is {}", path.string(),
              S_ISDIR(info.st_mode) ? "a folder" : "not a regular file");
}

Result<std::string> read_file(const std::filesystem::path& path, std::size_t max_bytes) {
  RAVE_TRY_ASSIGN(const int opened, open_regular_file(path));
  const Descriptor file(opened);
  std::string content;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(file.get(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_failure(path, "read");
    if (count == 0) return content;
    // Read to the end instead of asking for the size: the file may grow meanwhile.
    content.append(buffer, static_cast<std::size_t>(count));
    if (content.size() > max_bytes) {
      return fail(ErrorCode::kIo, "cannot read `{}`: it is larger than {} bytes", path.string(),
                  max_bytes);
    }
  }
}

namespace {

Status replace_file(const std::filesystem::path& path, ::mode_t mode, std::string_view content) {
  // Beside the target, because rename() replaces a file at once only within a file system.
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.part", ::getpid());
  Status written = create_file(temporary, O_TRUNC, mode, content);
  if (written && ::rename(temporary.c_str(), path.c_str()) != 0) {
    written = system_failure(path, "replace");
  }
  if (!written) ::unlink(temporary.c_str());
  return written;
}

}  // namespace

Status write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  return replace_file(path, 0644, content);
}

Status write_private_file_atomically(const std::filesystem::path& path, std::string_view content) {
  return replace_file(path, 0600, content);
}

Status check_private_file(const std::filesystem::path& path) {
  struct stat about {};
  // Who opens it says better what is wrong with a missing file.
  if (::stat(path.c_str(), &about) != 0) return {};
  // As ssh does. A group of another user's file may be meant to read it, as that of a key that
  // several servers of a machine share.
  const bool own = about.st_uid == ::geteuid();
  if ((about.st_mode & (own ? 077U : 007U)) == 0) return {};
  return fail(ErrorCode::kState, "other users can read the private key `{0}`; run `chmod 600 {0}`",
              path.string());
}

Status write_private_file(const std::filesystem::path& path, std::string_view content) {
  // O_EXCL also refuses a link that another user has put there. The mode is set at creation, so
  // there is no moment in which others could read the file.
  return create_file(path, O_EXCL, 0600, content);
}

Status create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return {};
  return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}", folder.string(),
              error.message());
}

}  // namespace rave
