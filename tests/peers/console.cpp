// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <sstream>

#include "arguments.hpp"

namespace peer {

Console::Console() {
  std::signal(SIGPIPE, SIG_IGN);
  fcntl(fd(), F_SETFL, fcntl(fd(), F_GETFL) | O_NONBLOCK);
}

void Console::say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

std::vector<std::vector<std::string>> Console::commands() {
  char room[1024];
  const ssize_t size = ::read(fd(), room, sizeof room);
  if (size == 0) std::exit(0);
  if (size > 0) pending_.append(room, static_cast<std::size_t>(size));
  std::vector<std::vector<std::string>> all;
  for (auto end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
    std::istringstream words(pending_.substr(0, end));
    pending_.erase(0, end + 1);
    std::vector<std::string>& command = all.emplace_back();
    for (std::string word; words >> word;) command.push_back(word);
    if (command.empty()) all.pop_back();
  }
  return all;
}

Log::Log(const std::string& path) {
  if (path.empty()) return;
  file_ = std::fopen(path.c_str(), "w");
  if (file_ == nullptr) give_up("cannot write " + path);
}

Log::~Log() {
  if (file_ != nullptr) std::fclose(file_);
}

void Log::write(const std::string& line) {
  if (file_ == nullptr) return;
  std::fwrite(line.data(), 1, line.size(), file_);
  std::fputc('\n', file_);
  std::fflush(file_);
}

}  // namespace peer
