// SPDX-License-Identifier: Apache-2.0
#include "one_module.hpp"

#include <cstdint>

namespace {
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): the C function has no state.
std::uintptr_t shown_address = 0;

struct Filter {
  rave::isolation::ModuleVisitor visitor;
  void* data;
};

bool holds(const dl_phdr_info& info, std::uintptr_t address) {
  for (int i = 0; i < info.dlpi_phnum; ++i) {
    const auto& part = info.dlpi_phdr[i];
    const std::uintptr_t begin = info.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && begin <= address && address < begin + part.p_memsz) return true;
  }
  return false;
}
}  // namespace

// The linker's --wrap=dl_iterate_phdr brings the calls of libbacktrace here, and gives the names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" int __real_dl_iterate_phdr(rave::isolation::ModuleVisitor visitor, void* data);
extern "C" int __wrap_dl_iterate_phdr(rave::isolation::ModuleVisitor visitor, void* data);
extern "C" int __wrap_dl_iterate_phdr(rave::isolation::ModuleVisitor visitor, void* data) {
  Filter filter{visitor, data};
  return __real_dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t size, void* raw) {
        const auto& inner = *static_cast<Filter*>(raw);
        if (shown_address != 0 && !holds(*info, shown_address)) return 0;
        return inner.visitor(info, size, inner.data);
      },
      &filter);
}
// NOLINTEND(readability-identifier-naming)

namespace rave::isolation {

int visit_all_modules(ModuleVisitor visitor, void* data) {
  return __real_dl_iterate_phdr(visitor, data);
}

void show_only_module_of(const void* address) {
  shown_address = reinterpret_cast<std::uintptr_t>(address);
}

}  // namespace rave::isolation
