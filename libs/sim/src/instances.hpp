// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/robot/interface.hpp"

namespace rave::sim {

/// Owns instances of one driver or program, side by side in memory.
class InstanceArray {
 public:
  InstanceArray() = default;
  InstanceArray(InstanceArray&& other) noexcept { *this = std::move(other); }
  InstanceArray& operator=(InstanceArray&& other) noexcept {
    std::swap(ops_, other.ops_);
    std::swap(memory_, other.memory_);
    std::swap(stride_, other.stride_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~InstanceArray() { clear(); }

  /// Constructs `count` instances; what was there before is destroyed.
  Status make(const InstanceOps& ops, std::size_t count) {
    clear();
    ops_ = &ops;
    const std::size_t alignment = ops.alignment < 64 ? 64 : ops.alignment;
    stride_ = (ops.size + ops.alignment - 1) / ops.alignment * ops.alignment;
    const std::size_t bytes = (stride_ * count + alignment - 1) / alignment * alignment;
    memory_ =
        static_cast<std::byte*>(std::aligned_alloc(alignment, bytes == 0 ? alignment : bytes));
    if (memory_ == nullptr) return fail(ErrorCode::kIo, "out of memory: {} bytes", bytes);
    for (; count_ < count; ++count_) {
      ErrorText error;
      if (ops.construct(memory_ + stride_ * count_, &error) != 0) {
        return fail(ErrorCode::kPlugin, "{}", error.text);
      }
    }
    return {};
  }

  void clear() noexcept {
    while (count_ > 0) ops_->destroy(memory_ + stride_ * --count_);
    std::free(memory_);
    memory_ = nullptr;
  }

  [[nodiscard]] void* at(std::size_t i) const noexcept { return memory_ + stride_ * i; }
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

 private:
  const InstanceOps* ops_ = nullptr;
  std::byte* memory_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t count_ = 0;
};

}  // namespace rave::sim
