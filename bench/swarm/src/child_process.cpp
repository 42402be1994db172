// SPDX-License-Identifier: Apache-2.0
#include "child_process.hpp"

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "rave/process/child.hpp"

namespace rave::swarm {
namespace {

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t size = ::read(descriptor, part.data(), part.size());
    if (size > 0) text.append(part.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

Result<ChildEnd> run_child(const std::filesystem::path& executable,
                           const std::vector<std::string>& arguments,
                           const std::vector<std::string>& without) {
  std::array<int, 2> ends{};
  // Closed on exec, so that the child has no copy of the end that is read from.
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return fail(ErrorCode::kIo, "cannot make a pipe: {}", std::system_category().message(errno));
  }
  const Descriptor from_child(ends[0]);
  Descriptor to_parent(ends[1]);
  process::ChildOptions options;
  options.words = {executable.string()};
  options.words.insert(options.words.end(), arguments.begin(), arguments.end());
  options.files = {{to_parent.get(), STDOUT_FILENO}};
  options.without_variables = without;
  RAVE_TRY_ASSIGN(auto child, process::Child::start(options));
  to_parent.reset();
  ChildEnd end;
  end.output = read_all(from_child.get());
  const auto how = child.wait(std::chrono::milliseconds(-1)).value_or(process::ChildEnd{});
  end.exit_code = how.exit_code.value_or(128 + how.signal.value_or(0));
  return end;
}

}  // namespace rave::swarm
