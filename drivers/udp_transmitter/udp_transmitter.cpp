// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "rave/base/thread.hpp"
#include "rave/line/datagram_socket.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave::udp_transmitter {
namespace {

constexpr std::uint32_t kMaxPacket = 1400;  // fits into one Ethernet frame with all headers

constexpr ParamSpec kParams[] = {
    text_param("listen", "127.0.0.1", "Numeric address of this machine to listen on."),
    integer_param("port", 0, 0, 65535, "UDP port to listen on; 0: a free one. Not with `group`."),
    text_param("peers", "", "Numeric addresses to send to: `127.0.0.1:4711 10.0.0.2:4711`."),
    text_param("group", "",
               "Multicast group to send to and receive from, such as 239.255.7.1:4711."),
    text_param("network", "rave", "Name of the network; packets of other networks are ignored."),
    number_param("byte_rate", "B/s", 0, 0, 1e12,
                 "Byte rate that all its communicators share; 0: no limit."),
};

/// Sends packets as datagrams. The host's thread calls configure(), open(), send(), close() and
/// report(); the driver's thread runs run().
class UdpTransmitter final : public Transmitter {
 public:
  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override {
    const Params params = setup.parameters();
    auto peers = line::parse_peers(params.text("peers"));
    if (!peers) return tl::unexpected(std::move(peers).error().with_context("`peers`"));
    peers_ = *std::move(peers);
    std::optional<line::Peer> group;
    auto port = static_cast<std::uint16_t>(params.integer("port"));
    if (!params.text("group").empty()) {
      auto parsed = line::parse_peer(params.text("group"));
      if (!parsed) return tl::unexpected(std::move(parsed).error().with_context("`group`"));
      if (port != 0) {
        return fail(ErrorCode::kInvalidArgument,
                    "`group` already has a port: give either `port` or `group`");
      }
      group = *std::move(parsed);
      // The group is one more address to send to.
      peers_.push_back(*group);
    }
    if (peers_.empty() && port == 0) {
      return fail(
          ErrorCode::kInvalidArgument,
          "expected `peers`, `group` or `port`: without them it can neither send nor receive");
    }
    RAVE_TRY(wake_.open());
    RAVE_TRY_ASSIGN(socket_, line::DatagramSocket::open(std::string(params.text("listen")), port,
                                                        group ? &*group : nullptr));
    declaration.max_packet_bytes = kMaxPacket;
    declaration.byte_rate = params.number("byte_rate");
    declaration.network = radio_name_hash(params.text("network"));
    declaration.boot = line::boot_number();
    return {};
  }

  Status open(PacketSink& sink) override {
    if (!socket_) return fail(ErrorCode::kState, "opened before it was configured");
    if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
    wake_.clear();
    sink_ = &sink;
    failed_ = false;
    return start_thread(thread_, "the socket", [this](const std::stop_token& stop) { run(stop); });
  }

  Status send(std::span<const std::byte> packet) override {
    Status worst;
    for (const line::Peer& peer : peers_) {
      Status status = socket_->send(packet, peer);
      if (!status) worst = std::move(status);
    }
    // A packet counts as sent only if all peers could be sent to.
    ++(worst ? sent_ : unsent_);
    // Reported when the state changes, not for each packet.
    if (worst.has_value() == failed_) {
      failed_ = !worst.has_value();
      if (failed_) {
        sink_->fail(worst.error().message.data(), worst.error().message.size());
      } else {
        sink_->recover();
      }
    }
    return worst;
  }

  void close() override { wake_.end(thread_); }

  [[nodiscard]] std::string report() const override {
    if (!socket_) return "{}";
    nlohmann::ordered_json json;
    json["port"] = socket_->port();
    json["sent"] = sent_;
    json["not_sent"] = unsent_;
    json["received"] = received_.load();
    return json.dump();
  }

 private:
  void run(const std::stop_token& stop) {
    std::array<std::byte, kMaxPacket + 1> room{};  // one byte more, to detect longer datagrams
    while (!stop.stop_requested()) {
      const auto got = socket_->receive(room, line::Wait(60'000), wake_);
      if (got.end == line::ReadEnd::kBytes) {
        ++received_;
        sink_->receive(room.data(), got.size);
      } else if (got.end == line::ReadEnd::kLost && wake_.wait(line::Wait(100))) {
        return;  // nothing can be received at present; send() reports the reason
      }
    }
  }

  std::vector<line::Peer> peers_;
  std::optional<line::DatagramSocket> socket_;
  line::Wake wake_;
  PacketSink* sink_ = nullptr;
  bool failed_ = false;  // of the host's thread, as the next two
  std::uint64_t sent_ = 0;
  std::uint64_t unsent_ = 0;
  std::atomic<std::uint64_t> received_{0};
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

}  // namespace
}  // namespace rave::udp_transmitter

RAVE_PLUGIN("udp_transmitter") {
  rave::add_transmitter<rave::udp_transmitter::UdpTransmitter>(
      registry, {.name = "udp_transmitter",
                 .summary = "Carries messages as UDP datagrams to peers or to a multicast group.",
                 .params = rave::udp_transmitter::kParams,
                 .clock = rave::DriverClock::kLive});
}
