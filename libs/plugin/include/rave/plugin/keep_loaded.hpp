// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::plugin {

/// The file that `address` (of a function or an object in it) was loaded from stays loaded until
/// the process ends, whoever unloads it: for a driver whose thread goes on. Nothing for an address
/// of the program itself, or null. Any thread.
void keep_loaded(const void* address) noexcept;

}  // namespace rave::plugin
