// SPDX-License-Identifier: Apache-2.0
#include "shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rave::isolation {

Result<SharedMemory> SharedMemory::create(std::size_t bytes) {
  Descriptor file(::memfd_create("rave-program", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (file.get() < 0 || ::ftruncate(file.get(), static_cast<off_t>(bytes)) != 0 ||
      // The seals fix the size. A child that could shrink the file would make the host fault when
      // it reads beyond the end.
      ::fcntl(file.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
    return fail(ErrorCode::kIo, "cannot make {} bytes of shared memory: {}", bytes,
                std::strerror(errno));
  }
  return map(std::move(file));
}

Result<SharedMemory> SharedMemory::map(Descriptor file) {
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) {
    return fail(ErrorCode::kIo, "cannot read the size of shared memory: {}", std::strerror(errno));
  }
  SharedMemory memory;
  memory.size_ = static_cast<std::size_t>(info.st_size);
  void* data = ::mmap(nullptr, memory.size_, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (data == MAP_FAILED) {
    return fail(ErrorCode::kIo, "cannot map {} bytes of shared memory: {}", memory.size_,
                std::strerror(errno));
  }
  memory.data_ = static_cast<std::byte*>(data);
  memory.file_ = std::move(file);
  return memory;
}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : file_(std::move(other.file_)),
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)) {}

SharedMemory& SharedMemory::operator=(SharedMemory&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

SharedMemory::~SharedMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

}  // namespace rave::isolation
