// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/probe_peer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include "rave/doctor/ports.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTries = 3;
/// Size of a question: it must be longer than its answer, which describes a whole machine.
constexpr std::size_t kQuestion = 1200;
/// From far below to far above the size of an Ethernet frame.
constexpr std::array<std::size_t, 7> kSizes = {1400, 1472, 4'000, 9'000, 16'000, 32'000, 64'000};

struct Asked {
  std::optional<Probe> answer;
  std::size_t size = 0;  ///< Size of the answer.
  std::optional<Error> error;
};

class Prober {
 public:
  Prober(const std::string& peer, const ProbeOptions& options)
      : peer_(peer), options_(options), bytes_(kLargestProbe + 1) {
    // Not to be guessed, so an answer must come from a machine that has received the question.
    std::random_device chance;
    number_ = (std::uint64_t{chance()} << 32U) | chance();
  }

  ProbeResult go();

 private:
  [[nodiscard]] Result<Socket> socket_to(std::uint16_t port) const;
  Asked ask(const Socket& socket, Probe probe, std::size_t bytes);
  [[nodiscard]] Result<std::optional<Probe>> await(const Socket& socket, Probe::Kind kind,
                                                   std::size_t& size);
  [[nodiscard]] std::optional<std::uint32_t> look_in_other_domains();
  void knock(const Socket& socket, ProbeResult& result);
  [[nodiscard]] bool answers_at(std::uint16_t port);
  void try_multicast(const Socket& socket, ProbeResult& result);
  void try_sizes(const Socket& socket, ProbeResult& result);

  const std::string& peer_;
  const ProbeOptions& options_;
  std::vector<char> bytes_;
  std::uint64_t number_ = 0;
};

/// Asks from a port that firewalls usually permit, if it is free.
Result<Socket> Prober::socket_to(std::uint16_t port) const {
  auto usual = Socket::bind({options_.address, asking_port(options_.domain)}, true);
  auto socket = usual ? std::move(usual) : Socket::bind({options_.address, 0});
  if (!socket) return tl::unexpected(socket.error());
  RAVE_TRY(socket->connect({peer_, port}));
  return socket;
}

/// Waits for the probe of that kind with the number of the question; others are ignored. Errors:
/// those of Socket::receive().
Result<std::optional<Probe>> Prober::await(const Socket& socket, Probe::Kind kind,
                                           std::size_t& size) {
  const auto end = Clock::now() + std::chrono::milliseconds(options_.patience_ms);
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return std::nullopt;
    RAVE_TRY_ASSIGN(const auto received, socket.receive(bytes_, static_cast<int>(left.count())));
    if (!received) return std::nullopt;
    auto probe = parse_probe({bytes_.data(), received->size});
    if (!probe || probe->kind != kind || probe->number != number_) continue;
    size = received->size;
    return *std::move(probe);
  }
}

Asked Prober::ask(const Socket& socket, Probe probe, std::size_t bytes) {
  Asked asked;
  for (int attempt = 0; attempt < kTries && !asked.answer; ++attempt) {
    probe.number = ++number_;
    probe.sent_ns = options_.clock();
    if (const Status sent = socket.send(write_probe(probe, bytes)); !sent) {
      asked.error = sent.error();
      continue;
    }
    auto answer = await(socket, Probe::Kind::kAnswer, asked.size);
    if (answer) {
      asked.answer = *std::move(answer);
    } else {
      asked.error = answer.error();
    }
  }
  return asked;
}

std::optional<std::uint32_t> Prober::look_in_other_domains() {
  const auto socket = Socket::bind({options_.address, 0});
  if (!socket) return std::nullopt;
  Probe probe;
  probe.number = ++number_;
  // All other domains are asked at once and one answer is enough, so the question costs one wait
  // and not one per domain.
  const std::string text = write_probe(probe, kQuestion);
  for (std::uint32_t domain = 0; domain <= kMostDomain; ++domain) {
    if (domain != options_.domain)
      static_cast<void>(socket->send(text, {peer_, doctor_port(domain)}));
  }
  std::size_t size = 0;
  const auto answer = await(*socket, Probe::Kind::kAnswer, size);
  return answer && *answer ? std::optional((*answer)->about.domain) : std::nullopt;
}

void Prober::knock(const Socket& socket, ProbeResult& result) {
  const Asked asked = ask(socket, {}, kQuestion);
  if (asked.answer) {
    result.port = ProbeResult::PortState::kOpen;
    result.about = asked.answer->about;
    return;
  }
  if (asked.error) {
    // "Refused" means that the machine is there and has answered by ICMP; only the listener is
    // missing.
    const bool refused = asked.error->code == ErrorCode::kNotFound;
    result.port = refused ? ProbeResult::PortState::kRefused : ProbeResult::PortState::kNoWay;
    result.why = asked.error->message;
  }
  result.other_domain = look_in_other_domains();
}

bool Prober::answers_at(std::uint16_t port) {
  if (port == 0) return false;
  const auto socket = socket_to(port);
  return socket && ask(*socket, {}, kQuestion).answer.has_value();
}

void Prober::try_multicast(const Socket& socket, ProbeResult& result) {
  const std::uint16_t port = multicast_port(options_.domain);
  auto group = Socket::bind({"0.0.0.0", port}, true);
  if (!group || !group->join(kMulticastGroup, options_.address)) return;
  // The answer is sent from the port of the doctor, to the origin of the question.
  auto asking = Socket::bind({options_.address, 0});
  if (!asking || !asking->join(kMulticastGroup, options_.address)) return;
  std::size_t size = 0;
  result.multicast_there = false;
  result.multicast_back = false;
  for (int attempt = 0; attempt < kTries && !*result.multicast_there; ++attempt) {
    Probe probe;
    probe.number = ++number_;
    static_cast<void>(asking->send(write_probe(probe, kQuestion), {kMulticastGroup, port}));
    // Other members of the group may answer as well.
    const auto answer = await(*asking, Probe::Kind::kAnswer, size);
    result.multicast_there = answer && *answer && (*answer)->by_multicast;
  }
  for (int attempt = 0; attempt < kTries && !*result.multicast_back; ++attempt) {
    Probe probe;
    probe.kind = Probe::Kind::kCall;
    probe.number = ++number_;
    static_cast<void>(socket.send(write_probe(probe)));
    const auto shout = await(*group, Probe::Kind::kShout, size);
    result.multicast_back = shout && *shout;
  }
}

void Prober::try_sizes(const Socket& socket, ProbeResult& result) {
  for (const std::size_t bytes : kSizes) {
    ProbeResult::Size size{bytes};
    Probe probe;
    probe.want = static_cast<std::uint32_t>(bytes);
    const Asked both = ask(socket, probe, bytes);
    size.there = size.back = both.answer && both.answer->size == bytes && both.size == bytes;
    // If the large answer is missing, a small one to the same question tells which direction loses
    // it.
    probe.want = 0;
    if (!size.there) size.there = ask(socket, probe, bytes).answer.has_value();
    result.sizes.push_back(size);
  }
}

ProbeResult Prober::go() {
  ProbeResult result;
  result.peer = peer_;
  const auto socket = socket_to(doctor_port(options_.domain));
  if (!socket) {
    result.port = ProbeResult::PortState::kNoWay;
    result.why = socket.error().message;
    return result;
  }
  knock(*socket, result);
  if (result.port != ProbeResult::PortState::kOpen) return result;
  bus::ClockOffset offset;
  // The one with the shortest way has the least error, as for the time of a run.
  constexpr int kReadings = 8;
  for (int i = 0; i < kReadings; ++i) {
    const Asked asked = ask(*socket, {}, kQuestion);
    if (!asked.answer) continue;
    const Probe& answer = *asked.answer;
    static_cast<void>(
        offset.add({answer.asked_ns, answer.received_ns, answer.sent_ns, options_.clock()}));
  }
  result.clock = offset.at(options_.clock());
  result.discovery_open = answers_at(result.about.discovery_port);
  result.data_open = answers_at(result.about.data_port);
  if (options_.multicast && result.about.hears_multicast) try_multicast(*socket, result);
  try_sizes(*socket, result);
  return result;
}

}  // namespace

ProbeResult probe_peer(const std::string& peer, const ProbeOptions& options) {
  return Prober(peer, options).go();
}

}  // namespace rave::doctor
