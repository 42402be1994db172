// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/listener.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <vector>

#include "rave/doctor/ports.hpp"
#include "rave/keys/key_set.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

constexpr int kLook_ms = 100;
constexpr int kMostParticipants = 120;
/// Further machines are answered but not reported.
constexpr std::size_t kMostMachines = 1000;

}  // namespace

About about_here(const bus::BusConfig& config, std::uint64_t stamp) {
  About about;
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) about.machine = name.data();
  about.version = RAVE_VERSION;
  about.interface_stamp = stamp;
  about.domain = config.domain;
  about.multicast = bus::kMulticastNames.at(static_cast<std::size_t>(config.multicast));
  if (!config.security.empty()) {
    const auto set = keys::read_key_set(config.security);
    about.authority = set ? set->authority.fingerprint : "unreadable";
  }
  return about;
}

struct Listener::Impl {
  Options options;
  std::vector<Socket> sockets{};  ///< The socket at the port of the doctor is the first.
  std::optional<Socket> group{};
  std::set<std::string> known{};
  std::vector<char> bytes = std::vector<char>(kLargestProbe + 1);

  Status open();
  void open_participant_ports();
  void answer(const Socket& socket, bool by_multicast,
              const std::function<void(const std::string&)>& heard);
};

/// The first two ports that a participant of DDS could have.
void Listener::Impl::open_participant_ports() {
  const std::uint32_t domain = options.about.domain;
  // A probe must use the ports that processes of a run use. A firewall that lets the port of the
  // doctor pass may still block those.
  for (int index = 0; index < kMostParticipants; ++index) {
    auto discovery = Socket::bind({options.address, discovery_port(domain, index)});
    auto data = Socket::bind({options.address, data_port(domain, index)});
    if (!discovery || !data) continue;
    options.about.discovery_port = discovery->port();
    options.about.data_port = data->port();
    sockets.push_back(*std::move(discovery));
    sockets.push_back(*std::move(data));
    return;
  }
}

Status Listener::Impl::open() {
  const std::uint32_t domain = options.about.domain;
  auto doctor = Socket::bind({options.address, doctor_port(domain)});
  if (!doctor && doctor.error().code == ErrorCode::kState) {
    return fail(ErrorCode::kState, "another `rave doctor --listen` already uses {}, UDP port {}",
                options.address, doctor_port(domain));
  }
  if (!doctor) return tl::unexpected(doctor.error());
  sockets.push_back(*std::move(doctor));
  open_participant_ports();
  // Shared, because processes of a run on this machine may listen to the group, too.
  auto shared = Socket::bind({"0.0.0.0", multicast_port(domain)}, true);
  if (shared && shared->join(kMulticastGroup, options.address)) {
    group.emplace(*std::move(shared));
    options.about.hears_multicast = true;
  }
  return {};
}

void Listener::Impl::answer(const Socket& socket, bool by_multicast,
                            const std::function<void(const std::string&)>& heard) {
  const auto received = socket.receive(bytes, 0);
  if (!received || !*received) return;
  const Socket::Received& got = **received;
  // Packets of DDS arrive at the same ports; they are ignored.
  const auto probe = parse_probe({bytes.data(), got.size});
  if (!probe) return;
  if (known.size() < kMostMachines && known.insert(got.from.address).second && heard) {
    heard(got.from.address);
  }
  Probe reply;
  reply.number = probe->number;
  reply.by_multicast = by_multicast;
  reply.size = static_cast<std::uint32_t>(got.size);
  reply.asked_ns = probe->sent_ns;
  if (probe->kind == Probe::Kind::kCall && group) {
    reply.kind = Probe::Kind::kShout;
    reply.sent_ns = options.clock();
    static_cast<void>(
        group->send(write_probe(reply), {kMulticastGroup, multicast_port(options.about.domain)}));
    return;
  }
  if (probe->kind != Probe::Kind::kAsk) return;
  reply.kind = Probe::Kind::kAnswer;
  reply.about = options.about;
  reply.received_ns = options.clock();
  reply.sent_ns = reply.received_ns;
  const std::string text = write_probe(reply, std::min<std::size_t>(probe->want, got.size));
  // An attacker cannot use this process to multiply packets.
  if (text.size() > got.size) return;
  // What came by multicast is answered from a port of its own.
  const Socket& from = by_multicast ? sockets.front() : socket;
  static_cast<void>(from.send(text, got.from));
}

Listener::Listener(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Listener::~Listener() = default;
const About& Listener::about() const noexcept { return impl_->options.about; }

Result<std::unique_ptr<Listener>> Listener::open(Options options) {
  auto impl = std::make_unique<Impl>(Impl{std::move(options)});
  RAVE_TRY(impl->open());
  return std::unique_ptr<Listener>(new Listener(std::move(impl)));
}

void Listener::serve(const std::function<bool()>& stopping,
                     const std::function<void(const std::string&)>& heard) {
  while (!stopping()) {
    std::vector<::pollfd> sources;
    for (const Socket& socket : impl_->sockets) sources.push_back({socket.descriptor(), POLLIN, 0});
    if (impl_->group) sources.push_back({impl_->group->descriptor(), POLLIN, 0});
    if (::poll(sources.data(), sources.size(), kLook_ms) <= 0) continue;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].revents == 0) continue;
      const bool shared = i == impl_->sockets.size();
      impl_->answer(shared ? *impl_->group : impl_->sockets[i], shared, heard);
    }
  }
}

}  // namespace rave::doctor
