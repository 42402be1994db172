// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rave::doctor {

enum class Verdict : std::uint8_t {
  kGood,
  kUnknown,  ///< It could not be checked; the text gives the reason.
  kAdvice,   ///< It works, but could be improved.
  kProblem,
};

/// The name in lower case, as in JSON.
[[nodiscard]] std::string_view to_string(Verdict verdict) noexcept;

/// The result of one check. A value.
struct Finding {
  std::string check;  ///< One word, such as `interface`.
  Verdict verdict = Verdict::kGood;
  std::string what{};  ///< One line of description.
  std::string mend{};  ///< The command that corrects the problem, in one line; empty if there is
                       ///< nothing to do.
};

using Findings = std::vector<Finding>;

/// Whether no finding is a problem.
[[nodiscard]] bool all_well(const Findings& findings) noexcept;

/// All findings as one JSON object in a line; docs/how-to/two-machines.md lists its keys.
[[nodiscard]] std::string to_json(const Findings& findings);

}  // namespace rave::doctor
