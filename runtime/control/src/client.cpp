// SPDX-License-Identifier: Apache-2.0
#include "rave/control/client.hpp"

#include <poll.h>

#include <chrono>

#include "rave/control/folder.hpp"
#include "rave/process/unix_socket.hpp"

namespace rave::control {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer than a run itself waits for its step to end.
constexpr auto kPatience = std::chrono::seconds(20);

Result<std::string> receive_line(int file) {
  std::string text;
  const auto end = Clock::now() + kPatience;
  while (text.size() <= kMaxAnswerBytes) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return fail(ErrorCode::kTimeout, "the run does not answer");
    pollfd watch{file, POLLIN, 0};
    if (::poll(&watch, 1, static_cast<int>(left.count())) <= 0) continue;
    char part[4096];
    const ssize_t size = ::recv(file, part, sizeof part, 0);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return fail(ErrorCode::kIo, "the run ended without an answer");
    text.append(part, static_cast<std::size_t>(size));
    const std::size_t line = text.find('\n');
    if (line != std::string::npos) return text.substr(0, line);
  }
  return fail(ErrorCode::kParse, "the answer of the run is incomplete");
}

}  // namespace

Result<Answer> ask(const std::string& run, const Request& request) {
  RAVE_TRY_ASSIGN(const auto folder, socket_folder());
  RAVE_TRY_ASSIGN(const Descriptor file, process::connect_to(folder / (run + ".sock")));
  if (!process::send_all(file.get(), write_request(request))) {
    return fail(ErrorCode::kIo, "the run does not accept connections: {}", std::strerror(errno));
  }
  RAVE_TRY_ASSIGN(const std::string line, receive_line(file.get()));
  return parse_answer(line);
}

}  // namespace rave::control
