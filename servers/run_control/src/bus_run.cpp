// SPDX-License-Identifier: Apache-2.0
#include "rave/run_control/bus_run.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/base/names.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::run_control {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// When nobody new has come for this long, all that are near have been heard of.
constexpr milliseconds kMoment{400};
/// What may have gone before the other end was known is sent again, then after twice as long.
constexpr milliseconds kFirstAgain{50};
constexpr milliseconds kLongestAgain{500};

/// What comes from elsewhere and is shown on a terminal; a list has lines.
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
  for (robot_host::RunStatus::Robot& robot : answer.status.robots) {
    robot.name = plain(robot.name);
    if (robot.hand_over) robot.hand_over->last = plain(robot.hand_over->last);
    if (!robot.shadow) continue;
    for (auto& reading : robot.shadow->readings) {
      reading.sensor = plain(reading.sensor);
      reading.unit = plain(reading.unit);
    }
  }
  return answer;
}

}  // namespace

struct BusRun::Impl {
  std::unique_ptr<bus::Bus> bus;
  bus::Reader<bus::HostInfo> infos;
  bus::Writer<bus::Wish> wishes;
  bus::Reader<bus::WishAnswer> answers;
  bus::WaitSet waits;
  std::string from;
  std::vector<BusPeer> peers{};
  std::uint64_t number = 0;  ///< Of the last wish.

  void look();
  [[nodiscard]] bool knows(std::uint64_t writer) const {
    return std::ranges::find(peers, writer, &BusPeer::writer) != peers.end();
  }
  [[nodiscard]] std::optional<Result<Answer>> take(const BusPeer& peer);
};

/// Learns who is there.
void BusRun::Impl::look() {
  infos.take([this](const bus::HostInfo& info) {
    if (knows(info.writer) || peers.size() >= rave_wire_kMaxHosts) return;
    peers.push_back({info.writer, info.name, info.host == rave_wire_kNone});
  });
  for (const bus::BusEvent& event : bus->take_events()) {
    if (event.kind != bus::EventKind::kParticipantLost || event.writer == 0) continue;
    std::erase_if(peers, [&](const BusPeer& peer) { return peer.writer == event.writer; });
  }
}

/// The answer to the last wish, if it has come.
std::optional<Result<Answer>> BusRun::Impl::take(const BusPeer& peer) {
  std::optional<Result<Answer>> result;
  answers.take([&](const bus::WishAnswer& answer) {
    const bool ours =
        answer.writer == peer.writer && answer.target == bus->writer() && answer.number == number;
    if (!ours || result) return;
    const std::string_view text = bus::text_of(answer.text);
    if (answer.taken) {
      result = read_answer(text);
    } else {
      result = Answer{false, std::string(text), {}};
    }
  });
  return result;
}

BusRun::BusRun(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
BusRun::~BusRun() = default;

Result<std::unique_ptr<BusRun>> BusRun::open(bus::BusConfig config, std::string_view from) {
  // Nobody in the run shall take it for a part of it.
  config.anonymous = true;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto wishes, bus::Writer<bus::Wish>::create(*bus));
  RAVE_TRY_ASSIGN(auto answers, bus::Reader<bus::WishAnswer>::create(*bus));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(infos));
  RAVE_TRY(waits.add(answers));
  RAVE_TRY(waits.add_events());
  return std::unique_ptr<BusRun>(new BusRun(std::unique_ptr<Impl>(
      new Impl{std::move(bus), std::move(infos), std::move(wishes), std::move(answers),
               std::move(waits), without_control_characters(from, " ")})));
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
  std::vector<std::string_view> names;
  for (const BusPeer& peer : run.peers) {
    if (!peer.manager) names.emplace_back(peer.name);
  }
  const std::string others =
      names.empty() ? std::string("nor any host") : "its hosts are " + join_names(names);
  if (!host.empty()) {
    return fail(ErrorCode::kNotFound, "host `{}` of the run is not there; {}", host, others);
  }
  return fail(ErrorCode::kNotFound,
              "the environment manager of the run is not there; {}; RUN@HOST asks a host", others);
}

std::vector<BusPeer> BusRun::all() {
  Impl& run = *impl_;
  const auto latest = Clock::now() + std::chrono::nanoseconds(kPatience.ns);
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
  std::string line = write_request(request);
  if (line.ends_with('\n')) line.pop_back();
  if (line.size() > rave_wire_kMaxWishBytes || has_control_characters(line)) {
    return fail(ErrorCode::kInvalidArgument,
                "what is asked has {} bytes, or control characters; the bus carries {} bytes of "
                "plain text",
                line.size(), rave_wire_kMaxWishBytes);
  }
  bus::Wish wish{};
  wish.target = peer.writer;
  wish.number = ++run.number;
  bus::put_text(wish.from, run.from);
  wish.text._buffer = reinterpret_cast<std::uint8_t*>(line.data());
  wish.text._length = static_cast<std::uint32_t>(line.size());
  wish.text._maximum = wish.text._length;
  const auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  auto send_at = Clock::now();
  auto again = kFirstAgain;
  while (Clock::now() < end) {
    if (Clock::now() >= send_at) {
      RAVE_TRY(run.wishes.write(wish));
      send_at = Clock::now() + again;
      again = std::min(2 * again, kLongestAgain);
    }
    static_cast<void>(run.waits.wait(bus::left_until(std::min(send_at, end))));
    if (auto answer = run.take(peer)) return *std::move(answer);
    run.look();
    if (!run.knows(peer.writer)) {
      return fail(ErrorCode::kState, "`{}` has gone without an answer", peer.name);
    }
  }
  return fail(ErrorCode::kTimeout,
              "`{}` has not answered for {} s: what was asked may still be done, and its log will "
              "say so; `rave top` shows how it fares (a RAVE that is older than this one takes no "
              "wishes from the bus)",
              peer.name, patience.seconds());
}

}  // namespace rave::run_control
