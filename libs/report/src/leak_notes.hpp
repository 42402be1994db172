// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::report {

/// Does nothing; a call makes the linker include the leak suppressions in the same file.
void link_leak_notes() noexcept;

}  // namespace rave::report
