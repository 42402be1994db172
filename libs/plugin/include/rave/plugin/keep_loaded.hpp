// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::plugin {

/// Keeps the shared object that contains `address` (a function or an object) loaded until the
/// process ends, also after it is unloaded. For a driver with a thread that cannot be stopped. Has
/// no effect for null or an address of the program itself. Any thread.
void keep_loaded(const void* address) noexcept;

}  // namespace rave::plugin
