// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/eventfd.h>

#include "rave/base/descriptor.hpp"

namespace rave {

/// Wakes a thread that waits for descriptors. If the system has no descriptor left, it is silent.
class Bell {
 public:
  Bell() noexcept : file_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  /// Never waits and takes no lock. Any thread.
  void ring() const noexcept { ::eventfd_write(file_.get(), 1); }
  /// Readable from ring() until it is read (8 bytes, see eventfd(2)); negative: silent.
  [[nodiscard]] int descriptor() const noexcept { return file_.get(); }

 private:
  Descriptor file_;
};

}  // namespace rave
