// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::report {

/// Does nothing; calling it makes a program link the suppressions beside it.
void link_leak_notes() noexcept;

}  // namespace rave::report
