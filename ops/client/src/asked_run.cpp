// SPDX-License-Identifier: Apache-2.0
#include "rave/client/asked_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "rave/base/names.hpp"
#include "rave/client/bus_search.hpp"
#include "rave/control/client.hpp"
#include "rave/control/folder.hpp"
#include "rave/watch/observer.hpp"

namespace rave::client {
namespace {

using control::Answer;
using control::BusPeer;
using control::BusRun;
using control::Request;

/// All processes of a run are looked at, one after the other; one that is well answers at once.
constexpr Duration kLookPatience = from_seconds(1.5);

/// Between a run and a host of it.
constexpr char kOfHost = '@';

/// A run on the bus, and the host of it that was named.
struct Found {
  std::shared_ptr<BusRun> bus;
  std::string run;   ///< For people.
  std::string host;  ///< Empty: none.
};

/// Who asks, for the logs of others.
std::string own_name() {
  const char* const user = std::getenv("USER");
  std::array<char, 256> machine{};
  if (::gethostname(machine.data(), machine.size() - 1) != 0) machine[0] = '\0';
  return fmt::format("{}@{}", user != nullptr && *user != '\0' ? user : "somebody",
                     machine[0] != '\0' ? machine.data() : "somewhere");
}

/// What there is on this machine instead of what was asked for.
std::string none_here(const std::string& word) {
  const auto runs = control::running_runs();
  const auto here = control::find_run(word);
  if (!runs || runs->empty() || here) return "no run is in progress on this machine";
  return here.error().message;
}

/// Of those here and of those on the bus there is none.
tl::unexpected<Error> none_at_all(const std::string& word, const bus::BusConfig& config,
                                  const Error& error) {
  const std::string where =
      fmt::format("on the bus in domain {} at {}", config.domain, config.interface);
  if (error.code != ErrorCode::kNotFound) {
    return fail(error.code, "{}; cannot search {}: {}", none_here(word), where, error.message);
  }
  const std::string_view remedy =
      "for a run on other machines, give --interface and --peer (or --multicast), --domain and "
      "--security as for its processes";
  return fail(ErrorCode::kNotFound, "{}; {}: {}\n{}", none_here(word), where, error.message,
              remedy);
}

/// What this command is on the bus.
Result<bus::BusConfig> asker_config(const bus::BusOptions& options) {
  RAVE_TRY_ASSIGN(auto config, bus_config(options, "rave", 0));
  make_room(config, bus::kMostHosts);
  return config;
}

/// How people say a run of which only the number is known.
std::string name_of(const bus::RunId& run) { return run.text().substr(0, 8); }

Result<Found> search_bus(const std::string& word, const bus::BusOptions& options) {
  const std::size_t mark = word.rfind(kOfHost);
  const std::string run_word = word.substr(0, mark);
  Found found;
  if (mark != std::string::npos) found.host = word.substr(mark + 1);
  RAVE_TRY_ASSIGN(auto config, asker_config(options));
  const auto run = find_bus_run(config, run_word, SearchFor::kAct, search_patience(config));
  if (!run) return none_at_all(word, config, run.error());
  config.run = *run;
  RAVE_TRY_ASSIGN(found.bus, BusRun::open(config, own_name()));
  // A number means nothing to a user who gave a name.
  const bool named = !run_word.empty() && !run->text().starts_with(run_word);
  found.run = named ? run_word : name_of(*run);
  return found;
}

std::string name_of(const Found& found, const BusPeer& peer) {
  return peer.manager ? found.run : fmt::format("{}{}{}", found.run, kOfHost, peer.name);
}

/// Whether a socket here is that of a host, and the scenario in its name.
bool names_host(std::string_view name) { return name.find(kOfHost) != std::string_view::npos; }
std::string_view scenario_of(std::string_view name) {
  return name.substr(0, std::min(name.find(kOfHost), name.rfind('-')));
}

/// The names of the sockets here of a scenario, of its hosts or of its runs themselves.
std::vector<std::string> here_of(std::string_view scenario, bool hosts) {
  std::vector<std::string> names;
  for (std::string& name : control::running_runs().value_or(std::vector<std::string>{})) {
    if (scenario_of(name) == scenario && names_host(name) == hosts)
      names.push_back(std::move(name));
  }
  return names;
}

/// Each once.
std::string machines_of(const std::vector<BusPeer>& peers) {
  std::set<std::string_view> machines;
  for (const BusPeer& peer : peers) {
    if (!peer.machine.empty()) machines.insert(peer.machine);
  }
  return join_names(std::vector<std::string_view>(machines.begin(), machines.end()));
}

}  // namespace

bool AskedRun::may_be_here(const std::string& word) {
  const auto runs = control::running_runs();
  if (!runs || runs->empty()) return false;
  if (word.empty() || control::find_run(word)) return true;
  // Of its scenario there are several, and which of them must be said.
  for (const std::string& run : *runs) {
    if (run.substr(0, run.rfind('-')) == word) return true;
  }
  return false;
}

Result<AskedRun> AskedRun::find(const std::string& word, const bus::BusOptions& options) {
  auto here = control::find_run(word);
  if (here) return AskedRun(*std::move(here));
  // Where the sockets are cannot be looked at, or it is one of those here.
  if (here.error().code != ErrorCode::kNotFound || may_be_here(word)) {
    return tl::unexpected(std::move(here).error());
  }
  RAVE_TRY_ASSIGN(const Found found, search_bus(word, options));
  RAVE_TRY_ASSIGN(auto peer, found.bus->find(found.host));
  std::string name = name_of(found, peer);
  return AskedRun(std::move(name), found.bus, std::move(peer));
}

Result<std::vector<AskedRun>> AskedRun::find_to_end(const std::string& word,
                                                    const bus::BusOptions& options) {
  RAVE_TRY_ASSIGN(const auto runs, control::running_runs());
  std::vector<AskedRun> hosts;
  bool any = false;
  for (const std::string& run : runs) {
    if (!word.empty() && scenario_of(run) != word) continue;
    any = any || !names_host(run);
    if (names_host(run)) hosts.emplace_back(run);
  }
  auto here = control::find_run(word);
  // A host is meant where nothing else can be, and where it is named.
  if (here && (!word.empty() || !names_host(*here))) {
    return std::vector<AskedRun>{AskedRun(*std::move(here))};
  }
  if (!here && (any || here.error().code != ErrorCode::kNotFound)) {
    return tl::unexpected(std::move(here).error());
  }
  const auto found = search_bus(word, options);
  if (!found && !hosts.empty()) return hosts;
  if (!found) return tl::unexpected(found.error());
  std::vector<BusPeer> peers = found->bus->all();
  std::erase_if(peers, [&](const BusPeer& peer) {
    return !found->host.empty() && (peer.manager || peer.name != found->host);
  });
  const auto manager = std::ranges::find_if(peers, &BusPeer::manager);
  if (manager != peers.end()) peers = {BusPeer(*manager)};
  // None is heard, and that has a reason.
  if (peers.empty()) return tl::unexpected(found->bus->find(found->host, Duration{}).error());
  std::vector<AskedRun> processes;
  for (const BusPeer& peer : peers) {
    processes.push_back(AskedRun(name_of(*found, peer), found->bus, peer));
  }
  return processes;
}

Result<AskedRun> AskedRun::find_on_bus(const std::string& word, const bus::BusOptions& options,
                                       const Has& has) {
  RAVE_TRY_ASSIGN(const Found found, search_bus(word, options));
  if (!found.host.empty()) {
    RAVE_TRY_ASSIGN(auto peer, found.bus->find(found.host));
    std::string name = name_of(found, peer);
    return AskedRun(std::move(name), found.bus, std::move(peer));
  }
  std::vector<AskedRun> having;
  std::optional<Error> silent;
  const std::vector<BusPeer> all = found.bus->all();
  for (const BusPeer& peer : all) {
    AskedRun run(name_of(found, peer), found.bus, peer);
    auto status = run.status(kLookPatience);
    if (!status) {
      if (!silent) silent = std::move(status).error();
    } else if (has(*status)) {
      having.push_back(std::move(run));
    }
  }
  if (having.size() == 1) return std::move(having.front());
  if (having.empty()) {
    // It may be what has it.
    if (silent) return tl::unexpected(*std::move(silent));
    // Where no process is heard, the wait was long enough.
    RAVE_TRY_ASSIGN(auto peer, found.bus->find({}, all.empty() ? Duration{} : BusRun::kPatience));
    return AskedRun(found.run, found.bus, std::move(peer));
  }
  std::vector<std::string_view> names;
  for (const AskedRun& run : having) names.emplace_back(run.name());
  return fail(ErrorCode::kNotFound, "several processes match: {}; name one of them",
              join_names(names));
}

Result<std::vector<Reply>> AskedRun::ask_each_on_bus(const std::string& word,
                                                     const bus::BusOptions& options,
                                                     const Request& request) {
  RAVE_TRY_ASSIGN(auto config, asker_config(options));
  const std::size_t mark = word.rfind(kOfHost);
  const std::string run_word = word.substr(0, mark);
  const std::string host = mark == std::string::npos ? std::string() : word.substr(mark + 1);
  // One participant for the search and for the request: with certificates each has to be believed
  // by all others first, which takes a while.
  config.all_runs = true;
  config.run = {};
  RAVE_TRY_ASSIGN(const auto bus, BusRun::open(config, own_name()));
  std::set<std::string> by_scenario;
  const auto meant = [&](const BusPeer& peer, const std::string& scenario) {
    if (scenario == run_word) by_scenario.insert(peer.run.text());
    const bool called = run_word.empty() || watch::is_called(peer.run, run_word);
    if (!called && scenario != run_word) return false;
    if (!host.empty()) return !peer.manager && peer.name == host;
    return !peer.manager || !peer.live;
  };
  const BusRun::Search search{search_patience(config), [&run_word](const BusPeer& peer) {
                                return watch::is_named(peer.run, run_word);
                              }};
  std::vector<Reply> replies;
  for (control::BusReply& reply : bus->ask_each(request, meant, BusRun::kPatience, &search)) {
    // A number means nothing to a user who gave a name.
    const bool named =
        watch::is_named(reply.peer.run, run_word) || by_scenario.contains(reply.peer.run.text());
    const std::string run = named ? run_word : name_of(reply.peer.run);
    replies.push_back(
        {reply.peer.manager ? run : fmt::format("{}{}{}", run, kOfHost, reply.peer.name),
         std::move(reply.answer)});
  }
  return replies;
}

bool AskedRun::is_host() const { return bus_ ? !peer_.manager : names_host(name_); }

std::vector<AskedRun> AskedRun::hosts() const {
  std::vector<AskedRun> hosts;
  if (bus_) {
    for (const BusPeer& peer : bus_->all(kLookPatience)) {
      if (peer.manager) continue;
      hosts.emplace_back(AskedRun(fmt::format("{}{}{}", name_, kOfHost, peer.name), bus_, peer));
    }
    return hosts;
  }
  for (const std::string& name : here_of(scenario_of(name_), true)) hosts.emplace_back(name);
  return hosts;
}

Result<std::vector<AskedRun>> AskedRun::controllers(bool sure) const {
  const std::vector<AskedRun> itself = {*this};
  if (is_host()) return itself;
  // In lock-step the manager stops and arms the robots of all.
  if (bus_ && !peer_.live) return itself;
  std::vector<AskedRun> hosts = this->hosts();
  if (bus_) return hosts.empty() ? itself : hosts;
  if (hosts.empty()) return itself;
  // Who does not answer is asked all the same.
  const auto said = status();
  if (!said || !said->live) return itself;
  const std::string_view scenario = scenario_of(name_);
  if (const auto runs = here_of(scenario, false); sure && runs.size() > 1) {
    std::vector<std::string_view> here;
    for (const AskedRun& host : hosts) here.emplace_back(host.name());
    return fail(
        ErrorCode::kNotFound,
        "{} runs of `{}` are on this machine, and their hosts cannot be told apart; name one of "
        "these: {}",
        runs.size(), scenario, join_names(here));
  }
  return hosts;
}

std::vector<AskedRun> AskedRun::takers_of_orders(const std::string& robot) const {
  const auto own = is_host() ? Result<runtime::RunStatus>() : status(kLookPatience);
  // A run of one process has no hosts, even if the same scenario runs elsewhere on the bus.
  if (!own || own->run.empty()) return {*this};
  std::vector<AskedRun> all;
  for (const AskedRun& host : hosts()) {
    const auto said = host.status(kLookPatience);
    if (!said || said->run != own->run) continue;
    const bool has =
        std::ranges::any_of(said->robots, [&robot](const auto& one) { return one.name == robot; });
    if (has) return {host};
    all.push_back(host);
  }
  return all.empty() ? std::vector<AskedRun>{*this} : all;
}

Result<std::vector<SeenRun>> AskedRun::all_on_bus(const bus::BusOptions& options) {
  RAVE_TRY_ASSIGN(auto config, asker_config(options));
  const auto all_that_time = [](const std::vector<watch::FoundRun>&) { return false; };
  RAVE_TRY_ASSIGN(const auto runs,
                  watch::find_runs(config, search_patience(config), all_that_time));
  std::vector<SeenRun> seen;
  for (const watch::FoundRun& run : runs) {
    config.run = run.run;
    RAVE_TRY_ASSIGN(std::shared_ptr<BusRun> bus, BusRun::open(config, own_name()));
    const Found found{bus, name_of(run.run), {}};
    // Who has certificates has to be believed first.
    const bool secured = !config.security.empty();
    std::vector<BusPeer> peers = bus->all(secured ? BusRun::kPatience : kLookPatience);
    if (peers.empty()) {
      auto last = bus->find({}, Duration{});
      if (!last) {
        seen.push_back({found.run, {}, tl::unexpected(last.error())});
        continue;
      }
      peers = {*std::move(last)};
    }
    const std::string machines = machines_of(peers);
    const auto manager = std::ranges::find_if(peers, &BusPeer::manager);
    const auto see = [&](const BusPeer& peer) {
      const AskedRun one(name_of(found, peer), bus, peer);
      seen.push_back({one.name(), peer.manager ? machines : peer.machine, one.status()});
    };
    // It knows of all; without it each host knows its own.
    if (manager == peers.end()) {
      std::ranges::for_each(peers, see);
      continue;
    }
    see(*manager);
    auto& status = seen.back().status;
    // In real time it does not know who may move.
    if (!status || !status->live) continue;
    for (const BusPeer& peer : peers) {
      if (peer.manager) continue;
      const auto told = AskedRun(peer.name, bus, peer).status(kLookPatience);
      if (told) complete(*status, *told);
    }
  }
  return seen;
}

Result<Answer> AskedRun::ask(const Request& request, Duration patience) const {
  return bus_ ? bus_->ask(peer_, request, patience) : control::ask(name_, request);
}

Result<runtime::RunStatus> AskedRun::status(Duration patience) const {
  RAVE_TRY_ASSIGN(auto answer, ask(Request{}, patience));
  if (!answer.good) return fail(ErrorCode::kState, "{}: {}", name_, answer.text);
  return std::move(answer.status);
}

void complete(runtime::RunStatus& manager, const runtime::RunStatus& host) {
  const bool is_told = std::ranges::any_of(manager.robots, &runtime::RunStatus::Robot::elsewhere);
  if (!is_told || manager.run.empty() || manager.run != host.run) return;
  std::map<std::string_view, const runtime::RunStatus::Robot*> by_name;
  for (const auto& robot : host.robots) by_name.emplace(robot.name, &robot);
  for (auto& robot : manager.robots) {
    const auto told = by_name.find(robot.name);
    if (robot.elsewhere && told != by_name.end()) robot = *told->second;
  }
}

}  // namespace rave::client
