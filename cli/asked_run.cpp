// SPDX-License-Identifier: Apache-2.0
#include "asked_run.hpp"

#include <fmt/format.h>

#include "error_text.hpp"

namespace rave::cli {

int refused(const AskedRun& run, const std::string& why) {
  complain(Error{ErrorCode::kState, why, {}}.with_context(run.name()));
  return kNotGood;
}

Result<int> ask_and_tell(const AskedRun& run, const control::Request& request) {
  RAVE_TRY_ASSIGN(const control::Answer answer, run.ask(request));
  if (!answer.good) return refused(run, answer.text);
  put(stdout, fmt::format("{}: {}\n", run.name(), answer.text));
  return kGood;
}

}  // namespace rave::cli
