// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::isolation {

/// Memory of fixed size that a child can map through its file descriptor.
class SharedMemory {
 public:
  /// Zeroed memory. Its size is sealed, so a child cannot shrink it and make the host fault.
  /// Errors: kIo.
  [[nodiscard]] static Result<SharedMemory> create(std::size_t bytes);
  /// Maps memory that a host created. Takes ownership of the descriptor. Errors: kIo.
  [[nodiscard]] static Result<SharedMemory> map(Descriptor file);

  SharedMemory() = default;
  SharedMemory(SharedMemory&& other) noexcept;
  SharedMemory& operator=(SharedMemory&& other) noexcept;
  ~SharedMemory();

  [[nodiscard]] int file() const noexcept { return file_.get(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// The object at `offset`, which must lie within the memory.
  template <class T>
  [[nodiscard]] T* at(std::size_t offset) const noexcept {
    return static_cast<T*>(static_cast<void*>(data_ + offset));
  }

 private:
  Descriptor file_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace rave::isolation
