// SPDX-License-Identifier: Apache-2.0
// `rave gui SCENARIO` beside `rave run SCENARIO --processes N`, with no other options: the run has
// a number that nobody was told.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>

#include "shared_world.hpp"
#include "signed_in.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;

class GuiSearch : public SharedWorld {
 protected:
  GuiSearch() {
    std::ofstream(folder_.path() / "index.html") << "<!doctype html><title>page</title>\n";
  }
  ~GuiSearch() override { end_gui(); }

  void start_gui(Words words) {
    end_gui();
    words.insert(words.begin(), "gui");
    words.insert(words.end(), {"--page", folder_.path(), "--port", "0", "--no-open"});
    for (const std::string& word : apart()) words.push_back(word);
    const std::string log = folder("gui.log");
    std::filesystem::remove(log);
    gui_ = start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()}, log);
    wait_until([&] { return SignedIn::is_in(content_of(log)); }, "the link");
    person_.emplace(content_of(log));
  }
  void start_run(Words words) {
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"--duration", "100000", "--no-record", "--pace", "1x", "--quiet"});
    for (const std::string& word : apart()) words.push_back(word);
    start_as_told("run", words);
  }
  /// What a page that is loaded now says of the run.
  [[nodiscard]] std::string time() const { return person_->page().text_with(R"("type":"time")"); }
  /// Waits until it says that.
  void expect_time(const std::string& said) {
    wait_until([&] { return time().find(said) != std::string::npos; }, said);
  }
  /// Waits until it shows a run that goes on.
  void expect_run() {
    wait_until(
        [this] {
          const std::string told = time();
          return told.find(R"("state":"running")") != std::string::npos &&
                 told.find(R"("step":0,)") == std::string::npos;
        },
        "the page shows the run");
  }

 private:
  void end_gui() {
    if (gui_ <= 0) return;
    ::kill(gui_, SIGKILL);
    static_cast<void>(wait_for(gui_));
    gui_ = -1;
  }
  pid_t gui_ = -1;
  std::optional<SignedIn> person_;
};

TEST_F(GuiSearch, TheRunIsShownWithoutOptionsWhicheverIsFirst) {
  start_gui({"flock", "--processes", "3"});
  expect_time("no process of the run was found");
  start_run({"flock", "--processes", "3"});
  expect_run();
  start_gui({"flock", "--processes", "3"});
  expect_run();
  // The number of processes is that of the run.
  start_gui({"flock"});
  expect_run();
  signal("run", SIGINT);
  static_cast<void>(end_of("run"));
}

}  // namespace
}  // namespace rave::cli_test
