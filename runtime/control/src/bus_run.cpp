// SPDX-License-Identifier: Apache-2.0
#include "rave/control/bus_run.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "answer_json.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/base/names.hpp"
#include "rave/bus/request_parts.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "repeat.hpp"

namespace rave::control {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// When no new process has appeared for this long, the search for processes is complete.
constexpr milliseconds kMoment{400};
/// The same while a process is seen that has not been believed yet: with certificates, a message of
/// the handshake that is lost is repeated after a second.
constexpr milliseconds kBelief{1200};

Result<std::string> request_line(const Request& request) {
  std::string line = write_request(request);
  if (line.ends_with('\n')) line.pop_back();
  if (line.size() <= rave_wire_kMaxRequestBytes && !has_control_characters(line)) return line;
  return fail(
      ErrorCode::kInvalidArgument,
      "the request has {} bytes, or control characters; expected at most {} bytes of plain text",
      line.size(), rave_wire_kMaxRequestBytes);
}

tl::unexpected<Error> gone(const BusPeer& peer) {
  return fail(ErrorCode::kState, "`{}` ended without an answer", peer.name);
}

tl::unexpected<Error> silent(const BusPeer& peer, Duration patience) {
  return fail(
      ErrorCode::kTimeout,
      "`{}` has not answered for {} s; the request may still be carried out, see its log; `rave "
      "top` shows its state (a RAVE older than this one takes no requests from the bus)",
      peer.name, patience.seconds());
}

/// A process that is asked, perhaps one of several at the same time.
struct Asked {
  BusPeer peer;
  std::uint64_t number = 0;
  std::string line;  ///< What it is asked: the request, or the rest of the answer.
  Clock::time_point until;
  Repeat repeat{};
  bus::AnswerParts parts{};
  std::optional<Result<Answer>> answer{};
};

}  // namespace

struct BusRun::Impl {
  std::unique_ptr<bus::Bus> bus;
  bus::Reader<bus::HostInfo> infos;
  bus::Reader<bus::RunState> states;
  bus::Writer<bus::Request> requests;
  bus::Reader<bus::RequestAnswer> answers;
  bus::WaitSet waits;
  std::string from;
  std::vector<BusPeer> peers{};
  Clock::time_point grew{};  ///< When the last of `peers` appeared.
  /// By run: its scenario, as its manager reports it.
  std::map<std::string, std::string> scenarios{};
  std::uint64_t number = 0;  ///< The number of the last request.

  void look();
  /// When the search for processes is complete, at most `latest`.
  [[nodiscard]] Clock::time_point search_end(Clock::time_point latest) const {
    const auto processes = bus->processes();
    const bool secured = !bus->config().security.empty();
    const bool doubtful = secured && std::ranges::any_of(processes, [](const auto& process) {
                            return process.run.none();
                          });
    return peers.empty() ? latest : std::min(latest, grew + (doubtful ? kBelief : kMoment));
  }
  [[nodiscard]] const std::string& scenario_of(const BusPeer& peer) {
    return scenarios[peer.run.text()];
  }
  [[nodiscard]] bool knows(std::uint64_t writer) const {
    return std::ranges::find(peers, writer, &BusPeer::writer) != peers.end();
  }
  Status send(const Asked& one);
  void take(std::vector<Asked>& asked, Duration patience);
  void read(Asked& one, const bus::RequestAnswer& answer, Duration patience);
  [[nodiscard]] Clock::time_point send_due(std::vector<Asked>& asked);
};

/// Reads which processes are present.
void BusRun::Impl::look() {
  infos.take([this](const bus::HostInfo& info) {
    if (knows(info.writer) || peers.size() >= rave_wire_kMaxHosts) return;
    BusPeer& peer = peers.emplace_back();
    peer = {info.writer, info.name, info.machine, info.host == rave_wire_kNone,
            info.clock == rave_wire_CLOCK_REAL_TIME};
    std::ranges::copy(info.run, peer.run.bytes.begin());
    grew = Clock::now();
  });
  states.take([this](const bus::RunState& state) {
    const auto peer = std::ranges::find(peers, state.writer, &BusPeer::writer);
    if (peer != peers.end()) scenarios[peer->run.text()] = plain_text(state.scenario);
  });
  for (const bus::BusEvent& event : bus->take_events()) {
    if (event.kind != bus::EventKind::kParticipantLost || event.writer == 0) continue;
    std::erase_if(peers, [&](const BusPeer& peer) { return peer.writer == event.writer; });
  }
}

Status BusRun::Impl::send(const Asked& one) {
  bus::Request request{};
  std::ranges::copy(one.peer.run.bytes, request.run);
  request.target = one.peer.writer;
  request.number = one.number;
  bus::put_text(request.from, from);
  bus::borrow_text(request.text, one.line);
  return requests.write(request);
}

/// Reads the answers of the processes that have not answered yet. The next part of a long one may
/// take `patience` again; there are few parts.
void BusRun::Impl::take(std::vector<Asked>& asked, Duration patience) {
  answers.take([&](const bus::RequestAnswer& answer) {
    if (answer.target != bus->writer()) return;
    const auto one = std::ranges::find_if(asked, [&](const Asked& other) {
      return other.peer.writer == answer.writer && other.number == answer.number;
    });
    if (one != asked.end() && !one->answer) read(*one, answer, patience);
  });
}

void BusRun::Impl::read(Asked& one, const bus::RequestAnswer& answer, Duration patience) {
  const std::string text(bus::text_of(answer.text));
  if (!answer.taken) {
    one.answer = Answer{false, plain_text(text), {}};
    return;
  }
  const std::size_t had = one.parts.text().size();
  if (Status added = one.parts.add(text); !added) {
    one.answer = tl::unexpected(std::move(added).error());
  } else if (one.parts.complete()) {
    one.answer = parse_answer(one.parts.text());
  } else if (one.parts.text().size() > had) {
    one.line = bus::request_for_rest(one.parts.text().size());
    one.repeat = {};
    one.until = Clock::now() + std::chrono::nanoseconds(patience.ns);
  }
}

/// Sends what is due to the processes that have not answered; returns when to do so again, which is
/// never if all have.
Clock::time_point BusRun::Impl::send_due(std::vector<Asked>& asked) {
  auto next = Clock::time_point::max();
  for (Asked& one : asked) {
    if (one.answer) continue;
    const auto now = Clock::now();
    if (!knows(one.peer.writer)) {
      one.answer = gone(one.peer);
      continue;
    }
    if (one.repeat.due(now)) {
      if (Status sent = send(one); !sent) {
        one.answer = tl::unexpected(std::move(sent).error());
        continue;
      }
      one.repeat.sent(now);
    }
    next = std::min(next, one.repeat.next());
  }
  return next;
}

BusRun::BusRun(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
BusRun::~BusRun() = default;

Result<std::unique_ptr<BusRun>> BusRun::open(bus::BusConfig config, std::string_view from) {
  // Other processes must not count this one as a participant of the run.
  config.anonymous = true;
  auto impl = std::make_unique<Impl>();
  impl->from = without_control_characters(from, " ");
  RAVE_TRY_ASSIGN(impl->bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*impl->bus, impl->infos, impl->states, impl->requests, impl->answers));
  RAVE_TRY_ASSIGN(impl->waits, bus::WaitSet::create(*impl->bus));
  RAVE_TRY(impl->waits.add(impl->infos, impl->states, impl->answers));
  RAVE_TRY(impl->waits.add_events());
  return std::unique_ptr<BusRun>(new BusRun(std::move(impl)));
}

Result<BusPeer> BusRun::find(std::string_view host, Duration patience) {
  Impl& run = *impl_;
  const auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  for (;;) {
    run.look();
    // The newest: that of a process which took the place of one that died a moment ago.
    const auto found =
        std::find_if(run.peers.rbegin(), run.peers.rend(), [host](const BusPeer& peer) {
          return host.empty() ? peer.manager : !peer.manager && peer.name == host;
        });
    if (found != run.peers.rend()) return *found;
    if (Clock::now() >= end) break;
    static_cast<void>(run.waits.wait(bus::left_until(end)));
  }
  if (run.peers.empty()) {
    // Without certificates one can see that a process exists, but read none of its messages.
    return fail(ErrorCode::kNotFound,
                "a run was found, but its messages cannot be read: processes with certificates "
                "talk only to members of their set; {}",
                run.bus->config().security.empty()
                    ? "give --security with the folder of a member"
                    : "these certificates belong to another set, or the run has none (then leave "
                      "--security out)");
  }
  std::vector<std::string_view> names;
  for (const BusPeer& peer : run.peers) {
    if (!peer.manager) names.emplace_back(peer.name);
  }
  const std::string others = names.empty() ? std::string("no host was found either")
                                           : "its hosts are " + join_names(names);
  if (!host.empty()) {
    return fail(ErrorCode::kNotFound, "host `{}` of the run was not found; {}", host, others);
  }
  return fail(ErrorCode::kNotFound,
              "the environment manager of the run was not found; {}; RUN@HOST addresses a host",
              others);
}

std::vector<BusPeer> BusRun::all(Duration patience) {
  Impl& run = *impl_;
  const auto latest = Clock::now() + std::chrono::nanoseconds(patience.ns);
  for (;;) {
    run.look();
    const auto end = run.search_end(latest);
    if (Clock::now() >= end) return run.peers;
    static_cast<void>(run.waits.wait(bus::left_until(end)));
  }
}

Result<Answer> BusRun::ask(const BusPeer& peer, const Request& request, Duration patience) {
  Impl& run = *impl_;
  RAVE_TRY_ASSIGN(std::string line, request_line(request));
  std::vector<Asked> asked;
  asked.push_back(
      {peer, ++run.number, std::move(line), Clock::now() + std::chrono::nanoseconds(patience.ns)});
  Asked& one = asked.front();
  while (!one.answer && Clock::now() < one.until) {
    const auto next = run.send_due(asked);
    if (one.answer) break;
    static_cast<void>(run.waits.wait(bus::left_until(std::min(next, one.until))));
    run.take(asked, patience);
    run.look();
  }
  return one.answer ? *std::move(one.answer) : silent(peer, patience);
}

std::vector<BusReply> BusRun::ask_each(const Request& request, const Meant& meant,
                                       Duration patience, const Search* search) {
  Impl& run = *impl_;
  const auto line = request_line(request);
  if (!line) return {};
  const auto began = Clock::now();
  const auto latest = began + std::chrono::nanoseconds(patience.ns);
  std::vector<Asked> asked;
  for (;;) {
    run.look();
    auto end = run.search_end(latest);
    if (search != nullptr && std::ranges::none_of(run.peers, search->only)) {
      end = began + std::chrono::nanoseconds(search->duration.ns);
    }
    for (const BusPeer& peer : run.peers) {
      const bool before = std::ranges::any_of(
          asked, [&peer](const Asked& one) { return one.peer.writer == peer.writer; });
      if (before || !meant(peer, run.scenario_of(peer))) continue;
      asked.push_back({peer, ++run.number, *line, latest});
    }
    run.take(asked, patience);
    const auto next = run.send_due(asked);
    const bool all =
        std::ranges::all_of(asked, [](const Asked& one) { return one.answer.has_value(); });
    if (Clock::now() >= latest || (all && Clock::now() >= end)) break;
    static_cast<void>(run.waits.wait(bus::left_until(std::min(latest, all ? end : next))));
  }
  std::vector<BusReply> replies;
  for (Asked& one : asked) {
    if (!one.answer) one.answer = silent(one.peer, patience);
    replies.push_back({std::move(one.peer), *std::move(one.answer)});
  }
  return replies;
}

}  // namespace rave::control
