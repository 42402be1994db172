// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave::process {

/// A word as a shell takes it for one: in quotes where it must be.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace rave::process
