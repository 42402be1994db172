// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/keep_loaded.hpp"

#include <dlfcn.h>

namespace rave::plugin {

void keep_loaded(const void* address) noexcept {
  Dl_info found{};
  if (address == nullptr || ::dladdr(address, &found) == 0 || found.dli_fname == nullptr) return;
  // The handle is never closed. For the program itself dlopen() fails, but it stays loaded anyway.
  static_cast<void>(::dlopen(found.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE));
}

}  // namespace rave::plugin
