// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::detail {
/// Writes the failed condition to the standard error stream and aborts.
[[noreturn]] void check_failed(const char* condition, const char* file, int line) noexcept;
}  // namespace rave::detail

/// For programmer mistakes only: aborts with file and line when `condition` is false, in every
/// build type. Bad input is an Error instead.
#define RAVE_CHECK(condition)                          \
  (static_cast<bool>(condition) ? static_cast<void>(0) \
                                : ::rave::detail::check_failed(#condition, __FILE__, __LINE__))
