// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rave::doctor {

enum class Verdict : std::uint8_t {
  kGood,
  kUnknown,  ///< It could not be looked at, and the text says why.
  kAdvice,   ///< It works so, and would work better otherwise.
  kProblem,
};

/// One word in lower case, as in JSON.
[[nodiscard]] std::string_view to_string(Verdict verdict) noexcept;

/// What one check found. A value.
struct Finding {
  std::string check;  ///< One word, such as `interface`.
  Verdict verdict = Verdict::kGood;
  std::string what{};  ///< One line for people.
  std::string mend{};  ///< The command that mends it, in one line; empty if nothing is to be done.
};

using Findings = std::vector<Finding>;

/// Whether there is no problem.
[[nodiscard]] bool all_well(const Findings& findings) noexcept;

/// All findings as one JSON object in a line; docs/how-to/two-machines.md has its keys.
[[nodiscard]] std::string to_json(const Findings& findings);

}  // namespace rave::doctor
