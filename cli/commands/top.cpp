// SPDX-License-Identifier: Apache-2.0
#include "commands/top.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "error_text.hpp"
#include "key_watch.hpp"
#include "rave/client/bus_search.hpp"
#include "rave/control/folder.hpp"
#include "rave/watch/lone_run.hpp"
#include "rave/watch/observer.hpp"
#include "rave/watch/page.hpp"

namespace rave::cli {
namespace {

constexpr Duration kTopSearch = from_seconds(3);
/// Rates need two messages of each process, which come once a second.
constexpr double kOnce_s = 2.5;

/// Looks on for a while and says what it has seen; the second word of it: with robots.
using Look = std::function<Result<watch::RunView>(Duration, bool, const std::stop_token&)>;

Look look_at(std::shared_ptr<watch::Observer> observer) {
  return [observer = std::move(observer)](Duration span, bool robots,
                                          const std::stop_token& stop) -> Result<watch::RunView> {
    observer->watch(span, stop);
    return observer->view(robots);
  };
}

void wait_for(Duration span, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, std::chrono::nanoseconds(span.ns),
                                         [] { return false; });
}

Look look_at(const std::string& lone_run) {
  // Has one owner, but a std::function must be copyable.
  auto run = std::make_shared<watch::LoneRun>(lone_run);
  return [run](Duration span, bool robots, const std::stop_token& stop) -> Result<watch::RunView> {
    RAVE_TRY(run->look(robots));
    wait_for(span, stop);
    return run->look(robots);
  };
}

Result<Look> join(bus::BusConfig config, const bus::RunId& run) {
  config.run = run;
  RAVE_TRY_ASSIGN(auto observer, watch::Observer::open(config));
  return look_at(std::shared_ptr<watch::Observer>(std::move(observer)));
}

Result<Look> find_shared_run(const bus::BusConfig& config, const std::string& word,
                             const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(const bus::RunId run,
                  client::find_bus_run(config, word, client::SearchFor::kLook, kTopSearch, stop));
  return join(config, run);
}

/// A run of several processes, or else one that this user has started here as one process.
Result<Look> find_run(const TopCommand& options, const bus::BusConfig& config,
                      const std::stop_token& stop) {
  auto shared = find_shared_run(config, options.run, stop);
  if (shared || shared.error().code != ErrorCode::kNotFound) return shared;
  const auto lone = control::find_run(options.run);
  if (lone) return look_at(*lone);
  const auto runs = control::running_runs();
  const bool none = !runs || runs->empty();
  if (!none) return tl::unexpected(lone.error());
  if (!options.run.empty()) return shared;
  return fail(
      ErrorCode::kNotFound,
      "no run is in progress: none on the bus in domain {} at {}, and none in one process\n"
      "start one, such as `rave run flock --processes 3`; for a run on other machines, give "
      "--interface and --peer (or --multicast) as for its processes",
      config.domain, config.interface);
}

/// The page of a terminal that changes in its place.
class Screen {
 public:
  Screen() { put(stdout, "\x1b[?1049h\x1b[?25l"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  ~Screen() { put(stdout, "\x1b[?25h\x1b[?1049l"); }

  /// All in one piece, and nothing is erased that is written again: it does not flicker.
  static void show(const std::vector<std::string>& lines) {
    std::string text = "\x1b[H";
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text += (i == 0 ? "" : "\r\n") + lines[i] + "\x1b[K";
    }
    put(stdout, text + "\x1b[J");
  }
};

/// What is printed where nothing can be changed in its place.
void print(const watch::RunView& view, const TopCommand& options) {
  if (options.json) {
    put(stdout, watch::to_json(view));
    return;
  }
  const Terminal terminal = terminal_of(stdout);
  std::string text;
  for (const std::string& line : watch::render_page(view, {terminal.width, 0, terminal.colour})) {
    text += line + "\n";
  }
  put(stdout, text + (options.once ? "" : "\n"));
}

Status show_live(const Look& look, const TopCommand& options, Duration interval, KeyWatch& keys) {
  const Screen screen;
  bool robots = options.robots;
  // The first page soon, for people do not wait gladly.
  Duration span = from_seconds(0.3);
  while (!keys.ended()) {
    RAVE_TRY_ASSIGN(const watch::RunView view, look(span, robots, keys.next()));
    span = interval;
    if (keys.take_toggle()) {
      robots = !robots;
      span = from_seconds(0.01);
      continue;
    }
    const Terminal terminal = terminal_of(stdout);
    watch::PageOptions page{terminal.width, terminal.height, terminal.colour, "q quit  r robots"};
    Screen::show(watch::render_page(view, page));
  }
  return {};
}

}  // namespace

Result<int> top(const TopCommand& options) {
  const bool live = terminal_of(stdout).is_terminal && !options.once && !options.json;
  KeyWatch keys(live && ::isatty(STDIN_FILENO) == 1);
  RAVE_TRY_ASSIGN(auto config, bus_config(options.bus, "rave top", 0));
  make_room(config, kMostHosts);
  const auto look = find_run(options, config, keys.end());
  if (keys.ended()) return kGood;
  if (!look) return tl::unexpected(look.error());
  const double usual_s = options.once ? kOnce_s : 1;
  const Duration interval = from_seconds(options.interval_s.value_or(usual_s));
  if (live) {
    RAVE_TRY(show_live(*look, options, interval, keys));
    return kGood;
  }
  bool over = false;  // The reader of a pipe waits for its end.
  do {
    RAVE_TRY_ASSIGN(const auto view, (*look)(interval, options.robots, keys.next()));
    print(view, options);
    over = view.phase == watch::Phase::kEnded || view.phase == watch::Phase::kFailed;
  } while (!options.once && !over && !keys.ended());
  return kGood;
}

}  // namespace rave::cli
