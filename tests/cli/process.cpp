// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace rave::cli_test {
namespace {

pid_t spawn(const std::vector<std::string>& arguments, const std::vector<std::string>& variables,
            const std::string& out, const std::string& err) {
  std::vector<std::string> words = {RAVE_BINARY_DIR "/bin/rave"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> settings = variables;
  for (const char* const name : {"PATH", "HOME", "ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"}) {
    if (const char* const value = std::getenv(name))
      settings.push_back(name + ("=" + std::string(value)));
  }
  std::vector<char*> argv;
  std::vector<char*> environment;
  for (std::string& word : words) argv.push_back(word.data());
  for (std::string& setting : settings) environment.push_back(setting.data());
  argv.push_back(nullptr);
  environment.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addchdir_np(&actions, RAVE_SOURCE_DIR "/tests/cli/data");
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  ::posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), kNew, 0600);
  ::posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), kNew, 0600);
  pid_t process = -1;
  const int failure =
      ::posix_spawn(&process, argv[0], &actions, nullptr, argv.data(), environment.data());
  ::posix_spawn_file_actions_destroy(&actions);
  return failure == 0 ? process : -1;
}

}  // namespace

Ended run_rave(const std::vector<std::string>& arguments,
               const std::vector<std::string>& variables) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "out";
  const std::string err = folder.path() / "err";
  const pid_t process = spawn(arguments, variables, out, err);
  Ended ended;
  ended.exit_code = wait_for(process);
  ended.out = content_of(out);
  ended.err = content_of(err);
  return ended;
}

pid_t start_rave(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& variables, const std::string& out) {
  return spawn(arguments, variables, out, "/dev/null");
}

int wait_for(pid_t process) {
  int status = 0;
  if (process < 0 || ::waitpid(process, &status, 0) != process) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = std::filesystem::temp_directory_path() / "rave-cli-XXXXXX";
  if (::mkdtemp(name.data()) != nullptr) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace rave::cli_test
