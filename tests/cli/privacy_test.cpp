// SPDX-License-Identifier: Apache-2.0
// What other users of the machine can read: nothing of a run, no link that signs in, no key.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "process.hpp"
#include "rave/web_testing/raw_client.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

unsigned mode_of(const fs::path& path) {
  struct stat about {};
  EXPECT_EQ(::stat(path.c_str(), &about), 0) << path;
  return about.st_mode & 0777U;
}

class Privacy : public ::testing::Test {
 protected:
  // The processes of these tests inherit it.
  Privacy() : before_(::umask(0)) {}
  ~Privacy() override {
    ::umask(before_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    static_cast<void>(wait_for(process_));
  }
  /// Number of files below a folder. Other users can read none of them.
  static int private_files(const fs::path& folder) {
    int files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      EXPECT_EQ(mode_of(entry.path()) & 077U, 0U) << entry.path();
      files += entry.is_regular_file() ? 1 : 0;
    }
    return files;
  }

  TemporaryFolder folder_;
  ::mode_t before_;
  pid_t process_ = -1;
};

TEST_F(Privacy, FilesOfARunAreOfTheUserAlone) {
  const fs::path made = folder_.path() / "made";
  const Ended ended = run_rave(
      {"run", "foxglove.yaml", "--output", made, "--quiet", "--pace", "max", "--duration", "3"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(mode_of(made), 0700U);
  EXPECT_GE(private_files(made), 5);
  EXPECT_TRUE(fs::exists(made / "run.mcap"));
  // A folder that was there keeps its mode, and what comes into it is private all the same.
  const fs::path given = folder_.path() / "given";
  fs::create_directory(given);
  EXPECT_EQ(
      run_rave({"run", "crowd.yaml", "--output", given, "--processes", "2", "--quiet"}).exit_code,
      0);
  EXPECT_EQ(mode_of(given), 0777U);
  EXPECT_GE(private_files(given), 10);
}

TEST_F(Privacy, TheLinkOfThePageIsOnNoCommandLine) {
  const fs::path base = folder_.path();
  fs::create_directory(base / "page");
  std::ofstream(base / "page/index.html") << "<!doctype html><title>page</title>\n";
  fs::create_directory(base / "bin");
  std::ofstream(base / "bin/xdg-open") << "#!/bin/sh\nprintf '%s' \"$*\" > \"$SEEN.part\"\n"
                                          "mv \"$SEEN.part\" \"$SEEN\"\n";
  fs::permissions(base / "bin/xdg-open", fs::perms(0755));
  // What it starts gets the path of this process.
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ((base / "bin").string() + ":" + path).c_str(), 1);
  const fs::path seen = base / "seen";
  process_ =
      start_rave({"run", "foxglove.yaml", "--duration", "100000", "--output", base / "out", "--gui",
                  "--page", base / "page", "--port", "0"},
                 {"DISPLAY=:99", "SEEN=" + seen.string(), "XDG_RUNTIME_DIR=" + base.string()});
  ::setenv("PATH", path.c_str(), 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!fs::exists(seen) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string opened = content_of(seen);
  EXPECT_EQ(opened.find("key="), std::string::npos) << opened;
  ASSERT_TRUE(fs::is_regular_file(opened)) << opened;
  EXPECT_EQ(mode_of(opened), 0600U);
  // The browser that reads the file comes in by the link in it.
  const std::string content = content_of(opened);
  const std::string begin = "url=http://127.0.0.1:";
  const std::size_t at = content.find(begin);
  ASSERT_NE(at, std::string::npos) << content;
  const std::string rest = content.substr(at + begin.size());
  const auto port = static_cast<std::uint16_t>(std::stoi(rest));
  const std::size_t slash = rest.find('/');
  web::testing::RawClient client(port, {});
  client.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                          rest.substr(slash, rest.find('"') - slash), port));
  const std::string answer = client.read_all();
  EXPECT_NE(answer.find("Set-Cookie: rave_"), std::string::npos) << answer;
  ASSERT_EQ(::kill(process_, SIGTERM), 0);
  static_cast<void>(wait_for(process_));
  process_ = -1;
  EXPECT_FALSE(fs::exists(opened));
}

TEST_F(Privacy, AKeyThatOthersCanReadIsRefused) {
  const fs::path keys = folder_.path() / "keys";
  ASSERT_EQ(run_rave({"keys", "new", keys, "env"}).exit_code, 0);
  const fs::path key = keys / "env/identity_key.pem";
  const auto refusal_of = [](const fs::path& file) {
    return "other users can read the private key `" + file.string() + "`; run `chmod 600 " +
           file.string() + "`";
  };
  for (const unsigned open : {0644U, 0640U}) {
    fs::permissions(key, fs::perms(open));
    const Ended ended = run_rave({"env", "crowd.yaml", "--security", keys / "env"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find(refusal_of(key)), std::string::npos) << ended.err;
  }
  const fs::path web = folder_.path() / "web";
  ASSERT_EQ(run_rave({"keys", "web", web, "127.0.0.1"}).exit_code, 0);
  const fs::path server_key = web / "server_key.pem";
  fs::permissions(server_key, fs::perms(0644));
  const std::vector<std::string> words = {"--certificate", web / "server.pem", "--key", server_key};
  std::vector<std::string> gui = {"run", "foxglove.yaml", "--gui", "--no-open", "--page", web};
  gui.insert(gui.end(), words.begin(), words.end());
  gui.insert(gui.end(), {"--output", folder_.path() / "out"});
  const Ended ended = run_rave(gui);
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find(refusal_of(server_key)), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
