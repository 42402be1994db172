// SPDX-License-Identifier: Apache-2.0
#include "byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "rave/base/regular_file.hpp"

namespace rave::record {

ByteSource::ByteSource(std::string name, ByteSpan bytes) noexcept
    : name_(std::move(name)), memory_(bytes), size_(bytes.size()) {}
ByteSource::ByteSource(std::string name, int fd, std::uint64_t size) noexcept
    : name_(std::move(name)), file_(fd), size_(size) {}
ByteSource::~ByteSource() = default;

Result<std::unique_ptr<ByteSource>> ByteSource::open(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const int fd, open_regular_file(path));
  struct stat info {};
  const bool known = ::fstat(fd, &info) == 0;
  auto size = known && info.st_size > 0 ? static_cast<std::uint64_t>(info.st_size) : 0;
  return std::unique_ptr<ByteSource>(new ByteSource(path.string(), fd, size));
}

Status ByteSource::read(std::uint64_t offset, std::uint64_t size, Bytes& out) const {
  if (offset > size_ || size > size_ - offset) {
    return fail(ErrorCode::kParse, "`{}`: {} bytes at offset {} reach beyond the end ({} bytes)",
                name_, size, offset, size_);
  }
  if (!file_) {
    const ByteSpan found = memory_.subspan(offset, size);
    out.assign(found.begin(), found.end());
    return {};
  }
  // Within the size of the file, which is checked above, so a damaged length cannot use up the
  // memory.
  out.resize(size);
  std::uint64_t done = 0;
  while (done < size) {
    const ssize_t count =
        ::pread(file_.get(), out.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return fail(ErrorCode::kIo, "cannot read `{}` at offset {}: {}", name_, offset + done,
                  count == 0 ? "the file was truncated" : std::strerror(errno));
    }
    done += static_cast<std::uint64_t>(count);
  }
  return {};
}

}  // namespace rave::record
