// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/companions.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/process/child.hpp"

namespace rave::launch {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kLookAround{200};
constexpr milliseconds kReadyPeriod{20};
/// A keeper gives its companion 1.5 s.
constexpr milliseconds kPatience{3000};
/// Of a log: more is not searched for the text that says that a companion is ready.
constexpr std::size_t kMostBytes = 4'000'000;

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

std::optional<fs::path> find_program(const std::string& word, const fs::path& rave) {
  if (word.find('/') != std::string::npos) {
    return is_program(word) ? std::optional<fs::path>(word) : std::nullopt;
  }
  if (const fs::path beside = rave.parent_path() / word; is_program(beside)) return beside;
  const char* const variable = std::getenv("PATH");
  std::string_view rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    if (const fs::path path = fs::path(folder) / word; !folder.empty() && is_program(path)) {
      return path;
    }
  }
  return std::nullopt;
}

std::string how(const process::ChildEnd& end) {
  return end.signal ? fmt::format("was ended by signal {}", *end.signal)
                    : fmt::format("exited with code {}", end.exit_code.value_or(-1));
}

/// The last line of an output that is not empty, for a message.
std::string last_line(std::string_view text) {
  const std::size_t end = text.find_last_not_of("\r\n \t");
  if (end == std::string_view::npos) return "nothing";
  text = text.substr(0, end + 1);
  const std::size_t begin = text.find_last_of('\n');
  return fmt::format("`{}`", text.substr(begin == std::string_view::npos ? 0 : begin + 1, 300));
}

/// A pipe whose reading end closes when this process dies.
Status make_life_line(Descriptor& ours, Descriptor& theirs) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return fail(ErrorCode::kIo, "cannot make a pipe");
  theirs = Descriptor(ends[0]);
  ours = Descriptor(ends[1]);
  return {};
}

}  // namespace

class Companions::Member {
 public:
  Member(config::CompanionFile file, fs::path log) : file_(std::move(file)), log_(std::move(log)) {}

  Status start(const fs::path& rave) {
    RAVE_TRY(Companions::find({file_}, rave));
    Descriptor theirs;
    RAVE_TRY(make_life_line(life_line_, theirs));
    const Descriptor output(::open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!output) return fail(ErrorCode::kIo, "cannot write `{}`", log_.string());
    process::ChildOptions options;
    options.words = {(rave.parent_path() / "rave-keeper").string()};
    options.words.insert(options.words.end(), file_.command->begin(), file_.command->end());
    options.words[1] = find_program(file_.command->front(), rave)->string();
    // Python holds its output back unless it writes to a terminal.
    options.variables.emplace_back("PYTHONUNBUFFERED=1");
    for (const auto& [name, value] : file_.environment) {
      options.variables.push_back(name + "=" + value.scalar());
    }
    // One file for both, so that the lines keep their order.
    options.files = {
        {theirs.get(), STDIN_FILENO}, {output.get(), STDOUT_FILENO}, {output.get(), STDERR_FILENO}};
    options.own_group = true;
    options.default_signals = true;
    RAVE_TRY_ASSIGN(child_, process::Child::start(options));
    return {};
  }

  /// Waits until the output has the text. `stopping`: whether the run is to end.
  template <class Stopping>
  Status await_ready(Stopping&& stopping) {
    if (!file_.ready) return {};
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(file_.ready_within_s);
    while (true) {
      const bool late = std::chrono::steady_clock::now() > until;
      const auto end = child_.wait(late ? milliseconds(0) : kReadyPeriod);
      const std::string output = read_file(log_, kMostBytes).value_or("");
      if (output.find(*file_.ready) != std::string::npos) return {};
      if (stopping()) return {};
      if (!end && !late) continue;
      const std::string what =
          end ? fmt::format("{} before it said `{}`", how(*end), *file_.ready)
              : fmt::format("did not say `{}` within {} s", *file_.ready, file_.ready_within_s);
      return fail_at(file_.name.where, ErrorCode::kState,
                     "companion `{}` {}; the last line of {} is {}", *file_.name, what,
                     log_.string(), last_line(output));
    }
  }

  /// Its end, once.
  std::optional<std::string> take_end() {
    if (told_) return std::nullopt;
    const auto end = child_.wait(milliseconds(0));
    if (!end) return std::nullopt;
    told_ = true;
    return how(*end);
  }

  void let_go() { life_line_ = Descriptor(); }
  void await_end() {
    if (!child_.wait(kPatience)) child_.kill();
  }

  [[nodiscard]] const config::CompanionFile& file() const noexcept { return file_; }
  [[nodiscard]] const fs::path& log() const noexcept { return log_; }

 private:
  config::CompanionFile file_;
  fs::path log_;
  Descriptor life_line_;
  process::Child child_;
  bool told_ = false;
};

Companions::Companions(Options options) : options_(std::move(options)) {}

Companions::~Companions() { static_cast<void>(end()); }

Status Companions::find(const std::vector<config::CompanionFile>& companions,
                        const fs::path& rave) {
  for (const config::CompanionFile& companion : companions) {
    const std::string& word = companion.command->front();
    if (find_program(word, rave)) continue;
    return fail_at(companion.command.where, ErrorCode::kNotFound,
                   "`command`: the program `{}` of companion `{}` {}", word, *companion.name,
                   word.find('/') == std::string::npos
                       ? "is neither beside rave nor in a folder of PATH"
                       : "is not a file that can be executed");
  }
  return {};
}

fs::path Companions::folder_of_run(const fs::path& run) {
  std::error_code error;
  const fs::path whole = fs::absolute(run / "companions", error);
  return (error ? run / "companions" : whole).lexically_normal();
}

Result<std::unique_ptr<Companions>> Companions::start(
    const std::vector<config::CompanionFile>& companions, Options options) {
  std::unique_ptr<Companions> started(new Companions(std::move(options)));
  const Options& own = started->options_;
  if (companions.empty()) return started;
  RAVE_TRY(create_folder(own.folder));
  for (const config::CompanionFile& companion : companions) {
    Member& member = *started->members_.emplace_back(
        std::make_unique<Member>(companion, own.folder / (*companion.name + ".log")));
    RAVE_TRY(member.start(own.program));
    RAVE_TRY(member.await_ready([&own] { return own.control.stopping(); }));
  }
  started->watcher_ =
      std::jthread([run = started.get()](const std::stop_token& stop) { run->watch(stop); });
  return started;
}

void Companions::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    for (const auto& member : members_) look_after(*member);
    stopped_.wait_for(lock, stop, kLookAround, [] { return false; });
  }
}

void Companions::look_after(Member& member) {
  const auto what = member.take_end();
  if (!what) return;
  const std::string text = fmt::format("companion `{}` {}; its output is in {}",
                                       *member.file().name, *what, member.log().string());
  if (member.file().on_end == config::CompanionEnd::kIgnore) {
    options_.log.warn("run", "{}", text);
    return;
  }
  options_.log.error("run", "{}; the run ends with it", text);
  problems_.push_back(text);
  options_.control.end_run();
}

std::vector<std::string> Companions::end() {
  if (watcher_.joinable()) {
    watcher_.request_stop();
    watcher_.join();
  }
  for (const auto& member : members_) member->let_go();
  for (const auto& member : members_) member->await_end();
  members_.clear();
  return std::exchange(problems_, {});
}

}  // namespace rave::launch
