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

/// Polls for what somewhere else is done, and writes it with `line`.
template <class Done>
BegunRequest awaited(std::future<Done> done, std::string told,
                     std::string (*line)(const Done& done)) {
  // shared_ptr because a std::function must be copyable, and it is shared with nothing else.
  const auto shared = std::make_shared<std::future<Done>>(std::move(done));
  return {[shared, line]() -> std::optional<std::string> {
            if (shared->wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
              return std::nullopt;
            }
            return line(shared->get());
          },
          std::move(told), true};
}

}  // namespace

bus::BeginRequest bus_requests_of(RunControl& control, ManagerRelay* relay) {
  return [&control, relay](std::string_view line) -> BegunRequest {
    const auto request = parse_request(line);
    if (!request) {
      return answered({false, request.error().message, {}},
                      "malformed request: " + request.error().message, false);
    }
    if (request->relay && relay != nullptr) {
      return awaited<Result<Answer>>(
          relay->post(*request), told_of(*request), [](const Result<Answer>& answer) {
            return line_of(answer ? *answer : Answer{false, answer.error().message, {}});
          });
    }
    if (const auto answer = answer_at_once(control, *request)) {
      return answered(*answer, told_of(*request));
    }
    auto posted = control.post(request->run);
    if (!posted) return answered({false, posted.error().message, {}}, told_of(*request));
    return awaited<Result<std::string>>(
        *std::move(posted), told_of(*request),
        [](const Result<std::string>& result) { return line_of(answer_of(result)); });
  };
}

}  // namespace rave::control
