// SPDX-License-Identifier: Apache-2.0
#include "byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace rave::record {

ByteSource::ByteSource(std::string name, ByteSpan bytes) noexcept
    : name_(std::move(name)), memory_(bytes), size_(bytes.size()) {}
ByteSource::ByteSource(std::string name, int fd, std::uint64_t size) noexcept
    : name_(std::move(name)), fd_(fd), size_(size) {}
ByteSource::~ByteSource() {
  if (fd_ >= 0) ::close(fd_);
}

Result<std::unique_ptr<ByteSource>> ByteSource::open(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int code = errno;
  if (fd < 0) {
    return fail(code == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot open `{}`: {}",
                path.string(), std::strerror(code));
  }
  struct stat info {};
  const bool known = ::fstat(fd, &info) == 0;
  auto size = known && info.st_size > 0 ? static_cast<std::uint64_t>(info.st_size) : 0;
  std::unique_ptr<ByteSource> source(new ByteSource(path.string(), fd, size));
  if (!known || !S_ISREG(info.st_mode)) {
    return fail(ErrorCode::kIo, "cannot read `{}`: it is no regular file", path.string());
  }
  return source;
}

Status ByteSource::read(std::uint64_t offset, std::uint64_t size, Bytes& out) const {
  if (offset > size_ || size > size_ - offset) {
    return fail(ErrorCode::kParse, "`{}`: {} bytes at offset {} reach beyond the end ({} bytes)",
                name_, size, offset, size_);
  }
  if (fd_ < 0) {
    const ByteSpan found = memory_.subspan(offset, size);
    out.assign(found.begin(), found.end());
    return {};
  }
  out.resize(size);
  std::uint64_t done = 0;
  while (done < size) {
    const ssize_t count =
        ::pread(fd_, out.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return fail(ErrorCode::kIo, "cannot read `{}` at offset {}: {}", name_, offset + done,
                  count == 0 ? "the file became shorter" : std::strerror(errno));
    }
    done += static_cast<std::uint64_t>(count);
  }
  return {};
}

}  // namespace rave::record
