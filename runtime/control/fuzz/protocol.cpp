// SPDX-License-Identifier: Apache-2.0
// Requests come from other processes: whatever is read back must be what is written.
#include "rave/control/protocol.hpp"

#include <cstddef>
#include <cstdint>

#include "rave/base/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::control;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto request = parse_request(line);
  if (request) {
    std::string again = write_request(*request);
    RAVE_CHECK(!again.empty() && again.back() == '\n' && again.find('\n') == again.size() - 1);
    again.pop_back();
    const auto same = parse_request(again);
    RAVE_CHECK(same && *same == *request);
  } else {
    RAVE_CHECK(!request.error().message.empty());
  }
  const auto answer = parse_answer(line);
  if (answer) RAVE_CHECK(parse_answer(write_answer(*answer)).has_value());
  return 0;
}
