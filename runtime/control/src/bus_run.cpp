// SPDX-License-Identifier: Apache-2.0
#include "rave/control/bus_run.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <tuple>
#include <utility>

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
/// The limit of messages about one request that are handled together.
constexpr std::size_t kMostAtOnce = 16;

/// Text from other processes made safe for a terminal: control characters are removed, except the
/// line ends of a list.
std::string plain(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t end = text.find('\n');
    result += without_control_characters(text.substr(0, end), " ");
    if (end == std::string_view::npos) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

Result<Answer> read_answer(std::string_view line) {
  RAVE_TRY_ASSIGN(Answer answer, parse_answer(line));
  answer.text = plain(answer.text);
  answer.status.scenario = plain(answer.status.scenario);
  answer.status.run = plain(answer.status.run);
  answer.status.waits_for = plain(answer.status.waits_for);
  for (runtime::RunStatus::Robot& robot : answer.status.robots) {
    robot.name = plain(robot.name);
    robot.lease = plain(robot.lease);
    robot.order = plain(robot.order);
    for (std::string& word : robot.takes) word = plain(word);
    for (auto& [key, value] : robot.changed)
      std::tie(key, value) = std::pair(plain(key), plain(value));
    if (robot.hand_over) robot.hand_over->last = plain(robot.hand_over->last);
    if (!robot.shadow) continue;
    for (auto& reading : robot.shadow->readings) {
      reading.sensor = plain(reading.sensor);
      reading.unit = plain(reading.unit);
    }
  }
  return answer;
}

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

/// One of several processes that are asked at the same time.
struct Asked {
  BusPeer peer;
  std::uint64_t number = 0;
  Repeat repeat{};
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
  std::string scenario{};    ///< The scenario of the run, as its manager reports it.
  std::uint64_t number = 0;  ///< The number of the last request.

  void look();
  [[nodiscard]] bool knows(std::uint64_t writer) const {
    return std::ranges::find(peers, writer, &BusPeer::writer) != peers.end();
  }
  /// A message about a request.
  struct Said {
    bool taken = false;
    std::string text;
  };
  [[nodiscard]] std::vector<Said> take(const BusPeer& peer);
  Status send(const BusPeer& peer, std::uint64_t request_number, std::string_view line);
  void take(std::vector<Asked>& asked);
  std::optional<Clock::time_point> send_due(std::vector<Asked>& asked, std::string_view line);
};

/// Reads which processes are present.
void BusRun::Impl::look() {
  infos.take([this](const bus::HostInfo& info) {
    if (knows(info.writer) || peers.size() >= rave_wire_kMaxHosts) return;
    peers.push_back({info.writer, info.name, info.machine, info.host == rave_wire_kNone,
                     info.clock == rave_wire_CLOCK_REAL_TIME});
  });
  states.take([this](const bus::RunState& state) {
    if (knows(state.writer)) scenario = plain(state.scenario);
  });
  for (const bus::BusEvent& event : bus->take_events()) {
    if (event.kind != bus::EventKind::kParticipantLost || event.writer == 0) continue;
    std::erase_if(peers, [&](const BusPeer& peer) { return peer.writer == event.writer; });
  }
}

/// The answers to the last request.
std::vector<BusRun::Impl::Said> BusRun::Impl::take(const BusPeer& peer) {
  std::vector<Said> said;
  answers.take([&](const bus::RequestAnswer& answer) {
    const bool ours =
        answer.writer == peer.writer && answer.target == bus->writer() && answer.number == number;
    // More answers than the request and its repetitions can cause: the sender is faulty.
    if (!ours || said.size() >= kMostAtOnce) return;
    said.push_back({answer.taken, std::string(bus::text_of(answer.text))});
  });
  return said;
}

Status BusRun::Impl::send(const BusPeer& peer, std::uint64_t request_number,
                          std::string_view line) {
  bus::Request request{};
  request.target = peer.writer;
  request.number = request_number;
  bus::put_text(request.from, from);
  bus::borrow_text(request.text, line);
  return requests.write(request);
}

/// Reads the answers of the processes that have not answered yet.
void BusRun::Impl::take(std::vector<Asked>& asked) {
  answers.take([&](const bus::RequestAnswer& answer) {
    if (answer.target != bus->writer()) return;
    const auto one = std::ranges::find_if(asked, [&](const Asked& other) {
      return other.peer.writer == answer.writer && other.number == answer.number;
    });
    if (one == asked.end() || one->answer) return;
    const std::string text(bus::text_of(answer.text));
    if (!answer.taken) {
      one->answer = Answer{false, plain(text), {}};
      return;
    }
    bus::AnswerParts parts;
    if (Status added = parts.add(text); !added) {
      one->answer = tl::unexpected(std::move(added).error());
    } else if (!parts.complete()) {
      one->answer = fail(ErrorCode::kParse, "the answer of `{}` is too long", one->peer.name);
    } else {
      one->answer = read_answer(parts.text());
    }
  });
}

/// Sends the request to the processes that have not answered, repeating it when due; returns when
/// to send next.
std::optional<Clock::time_point> BusRun::Impl::send_due(std::vector<Asked>& asked,
                                                        std::string_view line) {
  std::optional<Clock::time_point> next;
  for (Asked& one : asked) {
    if (one.answer) continue;
    if (!knows(one.peer.writer)) {
      one.answer = gone(one.peer);
      continue;
    }
    if (const auto now = Clock::now(); one.repeat.due(now)) {
      if (Status sent = send(one.peer, one.number, line); !sent) {
        one.answer = tl::unexpected(std::move(sent).error());
        continue;
      }
      one.repeat.sent(now);
    }
    next = std::min(next.value_or(one.repeat.next()), one.repeat.next());
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
    const auto found = std::ranges::find_if(run.peers, [host](const BusPeer& peer) {
      return host.empty() ? peer.manager : !peer.manager && peer.name == host;
    });
    if (found != run.peers.end()) return *found;
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
  auto end = latest;
  std::size_t known = 0;
  for (;;) {
    run.look();
    if (run.peers.size() > known) {
      known = run.peers.size();
      end = std::min(latest, Clock::now() + kMoment);
    }
    if (Clock::now() >= end) return run.peers;
    static_cast<void>(run.waits.wait(bus::left_until(end)));
  }
}

Result<Answer> BusRun::ask(const BusPeer& peer, const Request& request, Duration patience) {
  Impl& run = *impl_;
  RAVE_TRY_ASSIGN(std::string line, request_line(request));
  ++run.number;
  bus::AnswerParts parts;
  auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  Repeat repeat;
  while (Clock::now() < end) {
    if (const auto now = Clock::now(); repeat.due(now)) {
      RAVE_TRY(run.send(peer, run.number, line));
      repeat.sent(now);
    }
    static_cast<void>(run.waits.wait(bus::left_until(std::min(repeat.next(), end))));
    const std::size_t had = parts.text().size();
    for (const Impl::Said& said : run.take(peer)) {
      if (!said.taken) return Answer{false, said.text, {}};
      RAVE_TRY(parts.add(said.text));
      if (parts.complete()) return read_answer(parts.text());
    }
    if (parts.text().size() > had) {
      line = bus::request_for_rest(parts.text().size());
      repeat = {};
      // Repeated for each part; there are few.
      end = Clock::now() + std::chrono::nanoseconds(patience.ns);
    }
    run.look();
    if (!run.knows(peer.writer)) return gone(peer);
  }
  return silent(peer, patience);
}

std::vector<BusReply> BusRun::ask_each(const Request& request, const Meant& meant,
                                       Duration patience) {
  Impl& run = *impl_;
  auto line = request_line(request);
  if (!line) return {};
  const auto latest = Clock::now() + std::chrono::nanoseconds(patience.ns);
  auto end = latest;  // The end of the search.
  std::size_t known = 0;
  std::vector<Asked> asked;
  for (;;) {
    run.look();
    if (run.peers.size() > known) end = std::min(latest, Clock::now() + kMoment);
    known = run.peers.size();
    for (const BusPeer& peer : run.peers) {
      const bool before = std::ranges::any_of(
          asked, [&peer](const Asked& one) { return one.peer.writer == peer.writer; });
      if (!before && meant(peer, run.scenario)) asked.push_back({peer, ++run.number});
    }
    run.take(asked);
    const auto next = run.send_due(asked, *line);
    const bool all =
        std::ranges::all_of(asked, [](const Asked& one) { return one.answer.has_value(); });
    if (Clock::now() >= latest || (all && Clock::now() >= end)) break;
    static_cast<void>(run.waits.wait(bus::left_until(std::min(latest, next.value_or(end)))));
  }
  std::vector<BusReply> replies;
  for (Asked& one : asked) {
    if (!one.answer) one.answer = silent(one.peer, patience);
    replies.push_back({std::move(one.peer), *std::move(one.answer)});
  }
  return replies;
}

}  // namespace rave::control
