// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/visit.hpp"

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
/// A question must be longer than its answer, with all that this says of itself.
constexpr std::size_t kQuestion = 1200;
/// From far below to far above what a frame of Ethernet holds.
constexpr std::array<std::size_t, 7> kSizes = {1400, 1472, 4'000, 9'000, 16'000, 32'000, 64'000};

struct Asked {
  std::optional<Letter> answer;
  std::size_t size = 0;  ///< Of the answer.
  std::optional<Error> error;
};

class Visitor {
 public:
  Visitor(const std::string& peer, const VisitOptions& options)
      : peer_(peer), options_(options), bytes_(kLargestLetter + 1) {
    std::random_device chance;
    number_ = (std::uint64_t{chance()} << 32U) | chance();
  }

  Visit go();

 private:
  [[nodiscard]] Result<Socket> socket_to(std::uint16_t port) const;
  Asked ask(const Socket& socket, Letter letter, std::size_t bytes);
  std::optional<Letter> await(const Socket& socket, Letter::Kind kind, std::size_t& size);
  [[nodiscard]] std::optional<std::uint32_t> look_in_other_domains();
  void knock(const Socket& socket, Visit& visit);
  [[nodiscard]] bool answers_at(std::uint16_t port);
  void try_multicast(const Socket& socket, Visit& visit);
  void try_sizes(const Socket& socket, Visit& visit);

  const std::string& peer_;
  const VisitOptions& options_;
  std::vector<char> bytes_;
  std::uint64_t number_ = 0;
};

/// From a port that a firewall lets answers in to, if it is free.
Result<Socket> Visitor::socket_to(std::uint16_t port) const {
  auto usual = Socket::bind({options_.address, asking_port(options_.domain)}, true);
  auto socket = usual ? std::move(usual) : Socket::bind({options_.address, 0});
  if (!socket) return tl::unexpected(socket.error());
  RAVE_TRY(socket->connect({peer_, port}));
  return socket;
}

/// The letter of that kind with our number; others are passed over.
std::optional<Letter> Visitor::await(const Socket& socket, Letter::Kind kind, std::size_t& size) {
  const auto end = Clock::now() + std::chrono::milliseconds(options_.patience_ms);
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return std::nullopt;
    const auto received = socket.receive(bytes_, static_cast<int>(left.count()));
    if (!received || !*received) return std::nullopt;
    auto letter = parse_letter({bytes_.data(), (*received)->size});
    if (!letter || letter->kind != kind || letter->number != number_) continue;
    size = (*received)->size;
    return *std::move(letter);
  }
}

Asked Visitor::ask(const Socket& socket, Letter letter, std::size_t bytes) {
  Asked asked;
  for (int attempt = 0; attempt < kTries && !asked.answer; ++attempt) {
    letter.number = ++number_;
    letter.sent_ns = options_.clock();
    if (const Status sent = socket.send(write_letter(letter, bytes)); !sent) {
      asked.error = sent.error();
      continue;
    }
    const auto end = Clock::now() + std::chrono::milliseconds(options_.patience_ms);
    while (!asked.answer) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
      if (left.count() <= 0) break;
      const auto received = socket.receive(bytes_, static_cast<int>(left.count()));
      if (!received) {
        asked.error = received.error();
        break;
      }
      if (!*received) break;
      auto answer = parse_letter({bytes_.data(), (*received)->size});
      if (!answer || answer->kind != Letter::Kind::kAnswer || answer->number != number_) continue;
      asked.size = (*received)->size;
      asked.answer = *std::move(answer);
    }
  }
  return asked;
}

std::optional<std::uint32_t> Visitor::look_in_other_domains() {
  const auto socket = Socket::bind({options_.address, 0});
  if (!socket) return std::nullopt;
  Letter letter;
  letter.number = ++number_;
  const std::string text = write_letter(letter, kQuestion);
  for (std::uint32_t domain = 0; domain <= kMostDomain; ++domain) {
    if (domain != options_.domain)
      static_cast<void>(socket->send(text, {peer_, doctor_port(domain)}));
  }
  std::size_t size = 0;
  const auto answer = await(*socket, Letter::Kind::kAnswer, size);
  return answer ? std::optional(answer->about.domain) : std::nullopt;
}

void Visitor::knock(const Socket& socket, Visit& visit) {
  const Asked asked = ask(socket, {}, kQuestion);
  if (asked.answer) {
    visit.door = Visit::Door::kOpen;
    visit.about = asked.answer->about;
    return;
  }
  if (asked.error) {
    const bool refused = asked.error->code == ErrorCode::kNotFound;
    visit.door = refused ? Visit::Door::kRefused : Visit::Door::kNoWay;
    visit.why = asked.error->message;
  }
  visit.other_domain = look_in_other_domains();
}

bool Visitor::answers_at(std::uint16_t port) {
  if (port == 0) return false;
  const auto socket = socket_to(port);
  return socket && ask(*socket, {}, kQuestion).answer.has_value();
}

void Visitor::try_multicast(const Socket& socket, Visit& visit) {
  const std::uint16_t port = multicast_port(options_.domain);
  auto group = Socket::bind({"0.0.0.0", port}, true);
  if (!group || !group->join(kMulticastGroup, options_.address)) return;
  // The answer comes from the port of the doctor, to where the question came from.
  auto asking = Socket::bind({options_.address, 0});
  if (!asking || !asking->join(kMulticastGroup, options_.address)) return;
  std::size_t size = 0;
  visit.multicast_there = false;
  visit.multicast_back = false;
  for (int attempt = 0; attempt < kTries && !*visit.multicast_there; ++attempt) {
    Letter letter;
    letter.number = ++number_;
    static_cast<void>(asking->send(write_letter(letter, kQuestion), {kMulticastGroup, port}));
    // Others of the group may answer as well.
    const auto answer = await(*asking, Letter::Kind::kAnswer, size);
    visit.multicast_there = answer && answer->by_multicast;
  }
  for (int attempt = 0; attempt < kTries && !*visit.multicast_back; ++attempt) {
    Letter letter;
    letter.kind = Letter::Kind::kCall;
    letter.number = ++number_;
    static_cast<void>(socket.send(write_letter(letter)));
    visit.multicast_back = await(*group, Letter::Kind::kShout, size).has_value();
  }
}

void Visitor::try_sizes(const Socket& socket, Visit& visit) {
  for (const std::size_t bytes : kSizes) {
    Visit::Size size{bytes};
    Letter letter;
    letter.want = static_cast<std::uint32_t>(bytes);
    const Asked both = ask(socket, letter, bytes);
    size.there = size.back = both.answer && both.answer->size == bytes && both.size == bytes;
    letter.want = 0;
    if (!size.there) size.there = ask(socket, letter, bytes).answer.has_value();
    visit.sizes.push_back(size);
  }
}

Visit Visitor::go() {
  Visit visit;
  visit.peer = peer_;
  const auto socket = socket_to(doctor_port(options_.domain));
  if (!socket) {
    visit.door = Visit::Door::kNoWay;
    visit.why = socket.error().message;
    return visit;
  }
  knock(*socket, visit);
  if (visit.door != Visit::Door::kOpen) return visit;
  bus::ClockOffset offset;
  constexpr int kReadings = 8;
  for (int i = 0; i < kReadings; ++i) {
    const Asked asked = ask(*socket, {}, kQuestion);
    if (!asked.answer) continue;
    const Letter& answer = *asked.answer;
    static_cast<void>(
        offset.add({answer.asked_ns, answer.received_ns, answer.sent_ns, options_.clock()}));
  }
  visit.clock = offset.at(options_.clock());
  visit.discovery_open = answers_at(visit.about.discovery_port);
  visit.data_open = answers_at(visit.about.data_port);
  if (options_.multicast && visit.about.hears_multicast) try_multicast(*socket, visit);
  try_sizes(*socket, visit);
  return visit;
}

}  // namespace

Visit visit(const std::string& peer, const VisitOptions& options) {
  return Visitor(peer, options).go();
}

}  // namespace rave::doctor
