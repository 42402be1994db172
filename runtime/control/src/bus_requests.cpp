// SPDX-License-Identifier: Apache-2.0
#include "rave/control/bus_requests.hpp"

#include <chrono>
#include <future>
#include <memory>

#include "answering.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/control/protocol.hpp"

namespace rave::control {
namespace {

using bus::BegunRequest;
using runtime::RunControl;

/// Omits what the bus does not carry.
std::string line_of(const Answer& answer) {
  std::string line = write_answer(answer);
  if (line.ends_with('\n')) line.pop_back();
  return without_control_characters(line, " ");
}

BegunRequest answered(const Answer& answer, std::string told, bool understood = true) {
  return {[line = line_of(answer)] { return std::optional(line); }, std::move(told), understood};
}

/// The log line for a request; empty for requests that only read.
std::string told_of(const Request& request) {
  if (request.only_reads()) return {};
  std::string text = write_request(request);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

}  // namespace

bus::BeginRequest bus_requests_of(RunControl& control) {
  return [&control](std::string_view line) -> BegunRequest {
    const auto request = parse_request(line);
    if (!request) {
      return answered({false, request.error().message, {}},
                      "malformed request: " + request.error().message, false);
    }
    if (const auto answer = answer_at_once(control, *request)) {
      return answered(*answer, told_of(*request));
    }
    auto posted = control.post(request->run);
    if (!posted) return answered({false, posted.error().message, {}}, told_of(*request));
    // shared_ptr because a std::function must be copyable, and it is shared with nothing else.
    const auto awaited = std::make_shared<std::future<Result<std::string>>>(*std::move(posted));
    return {[awaited]() -> std::optional<std::string> {
              if (awaited->wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
                return std::nullopt;
              }
              return line_of(answer_of(awaited->get()));
            },
            told_of(*request), true};
  };
}

}  // namespace rave::control
