// SPDX-License-Identifier: Apache-2.0
// Font configuration keeps what it has read until the process ends, and its library is not told to
// let go of it by cairo; the leak sanitizer would report that for every program that draws.
#include "leak_notes.hpp"

namespace rave::report {
void link_leak_notes() noexcept {}
}  // namespace rave::report

#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __lsan_default_suppressions();
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}
#endif
