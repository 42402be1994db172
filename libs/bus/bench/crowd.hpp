// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace rave::bus::bench {

/// Joins a crowd as `name`, a number: introduces itself, says on the standard output when it knows
/// `others` processes and they read what it writes, and then each time one of them is gone: the
/// nanoseconds of the monotonic clock and who. For a process of its own; never returns.
[[noreturn]] void attend(const std::string& run, const std::string& name, std::size_t others);

/// Starts `processes` of them, measures until all know all, then kills `deaths` of them one after
/// the other at random moments and measures until the last of the others knows it. Prints JSON.
int crowd(std::size_t processes, std::size_t deaths);

}  // namespace rave::bus::bench
