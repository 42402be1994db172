// SPDX-License-Identifier: Apache-2.0
#include "conducted_run.hpp"

#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <utility>

#include "places.hpp"
#include "rave/bus/bus_options.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/launch/run_bus.hpp"
#include "rave/launch/run_folder.hpp"
#include "rave/protocol/agreement.hpp"
#include "run_page.hpp"

namespace rave::cli {
namespace {

constexpr std::streamoff kMostLogBytes = 32'768;
/// For the results of a run that ends with this process.
constexpr std::chrono::seconds kEndPatience{20};

/// The end of a file, in lines.
std::vector<std::string> last_lines(const std::filesystem::path& file, std::size_t lines) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  if (size <= 0) return {};
  std::string text(static_cast<std::size_t>(std::min(size, kMostLogBytes)), '\0');
  stream.seekg(size - static_cast<std::streamoff>(text.size()));
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  std::vector<std::string> last;
  std::size_t end = text.size();
  while (end > 0 && last.size() < lines) {
    const std::size_t before = text.rfind('\n', end - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    if (begin < end) last.insert(last.begin(), text.substr(begin, end - begin));
    end = before == std::string::npos ? 0 : before;
  }
  return last;
}

}  // namespace

Result<std::unique_ptr<ConductedRun>> ConductedRun::start(const RunCommand& asked,
                                                          const config::ExpandedScenario& scenario,
                                                          gui_server::GuiServer& page,
                                                          LogSink& log) {
  std::unique_ptr<ConductedRun> run(new ConductedRun);
  RunCommand options = asked;
  RAVE_TRY_ASSIGN(const auto folder,
                  launch::RunFolder::create({asked.output, false, {}}, *scenario.scenario.name));
  run->folder_ = folder.path();
  options.output = folder.path().string();
  options.bus.run = bus::RunId::random().text();
  // Robots are ordered over lines of their own, for which the run knows the key of this page.
  if (options.page.line_key.empty()) {
    options.page.line_key = folder.path() / "line_key";
    RAVE_TRY(direct_line::make_key_files(options.page.line_key));
  }
  RAVE_TRY(run->start_process(options));
  RAVE_TRY(run->show_on(options, scenario, page, log));
  return run;
}

Status ConductedRun::start_process(const RunCommand& options) {
  RAVE_TRY_ASSIGN(const auto run, bus::RunId::parse(options.bus.run));
  RAVE_TRY_ASSIGN(const auto file, find_scenario(options.scenario));
  const Descriptor output(
      ::open((folder_ / "printed.log").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (!output) return fail(ErrorCode::kIo, "cannot write to `{}`", folder_.string());
  process::ChildOptions child;
  child.words = {options.program.string(), "run",    file.string(), "--output",
                 folder_.string(),         "--pace", "realtime",    "--on-bus",
                 "--with-parent"};
  if (options.seed) {
    child.words.insert(child.words.end(), {"--seed", std::to_string(*options.seed)});
  }
  for (const std::string& word : bus::words_of(options.bus, run)) child.words.push_back(word);
  for (const std::string& folder : options.plugins) {
    child.words.insert(child.words.end(), {"--plugins", folder});
  }
  child.words.insert(child.words.end(), {"--web", options.page.listen + ":0", "--web-key",
                                         options.page.line_key + ".pub"});
  if (!options.page.certificate.empty()) {
    child.words.insert(child.words.end(), {"--web-certificate", options.page.certificate.string(),
                                           "--web-certificate-key", options.page.key.string()});
  }
  child.files = {{output.get(), STDOUT_FILENO}, {output.get(), STDERR_FILENO}};
  child.no_input = true;
  // Ctrl-C is for this process, which ends the run in its own time.
  child.own_group = true;
  child.default_signals = true;
  RAVE_TRY_ASSIGN(child_, process::Child::start(child));
  return {};
}

Status ConductedRun::show_on(const RunCommand& options, const config::ExpandedScenario& scenario,
                             gui_server::GuiServer& page, LogSink& log) {
  RAVE_TRY_ASSIGN(auto bus,
                  bus::bus_config(options.bus, "GUI Server", runtime::shared_number(scenario)));
  bus::make_room(bus, bus::kMostHosts);
  RAVE_TRY_ASSIGN(auto source, look_on(options, scenario, bus, nullptr, log));
  page.show(std::move(source));
  return offer_lines(options, scenario, bus, page);
}

ConductedRun::~ConductedRun() {
  if (child_.id() == 0) return;
  child_.signal(SIGINT);
  if (!child_.wait(kEndPatience)) child_.kill();
}

std::optional<process::ChildEnd> ConductedRun::wait(std::chrono::milliseconds longest) {
  return child_.wait(longest);
}

void ConductedRun::end() { child_.signal(std::exchange(asked_to_end_, true) ? SIGKILL : SIGINT); }

std::vector<std::string> ConductedRun::log_lines(std::size_t lines) const {
  auto last = last_lines(folder_ / "console.log", lines);
  // What is printed alone: why a run did not begin, and its results.
  if (last.size() < lines) {
    const auto printed = last_lines(folder_ / "printed.log", lines - last.size());
    last.insert(last.end(), printed.begin(), printed.end());
  }
  return last;
}

}  // namespace rave::cli
