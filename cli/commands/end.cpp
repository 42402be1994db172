// SPDX-License-Identifier: Apache-2.0
#include "commands/end.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "terminal.hpp"

namespace rave::cli {

Result<int> end_run(const EndCommand& options) {
  RAVE_TRY_ASSIGN(const auto processes, AskedRun::find_to_end(options.run, options.bus));
  control::Request request;
  request.own = control::End();
  int code = kGood;
  for (const AskedRun& process : processes) {
    const auto answer = process.ask(request);
    // On the bus it may be gone before its answer is here, which is what was asked for.
    const bool gone = !answer && answer.error().code == ErrorCode::kState;
    if (gone || (answer && answer->good)) {
      put(stdout, fmt::format("{}: ends\n", process.name()));
      continue;
    }
    const std::string why = answer ? answer->text : answer.error().message;
    code = refused(process, why);
  }
  return code;
}

}  // namespace rave::cli
