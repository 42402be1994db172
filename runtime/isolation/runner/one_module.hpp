// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <link.h>

#include <cstddef>

namespace rave::isolation {

using ModuleVisitor = int (*)(dl_phdr_info* info, std::size_t size, void* data);

/// dl_iterate_phdr as the C library has it: all modules of the process.
int visit_all_modules(ModuleVisitor visitor, void* data);

/// Limits libbacktrace to the module that contains `address`. Otherwise it reads the debug
/// information of all modules, which for the system's libraries takes longer than the rest of the
/// start.
void show_only_module_of(const void* address);

}  // namespace rave::isolation
