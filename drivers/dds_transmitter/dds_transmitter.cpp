// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "dds_network/network_words.hpp"
#include "dds_transmitter/air.hpp"
#include "rave/line/host_clock.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave::dds_transmitter {
namespace {

constexpr ParamSpec kParams[] = {
    text_param("network", "rave",
               "Name of the network; transmitters with the same name hear each other."),
    text_param("run", "", "32 hexadecimal digits that replace those derived from `network`."),
    dds_network::domain_param("Domain of DDS: chooses the UDP ports."),
    text_param("interface", "127.0.0.1",
               "Network interface, by address or name; the default is this machine."),
    text_param("peers", "", "Addresses of other machines, separated by commas."),
    choice_param("multicast", "none", bus::kMulticastNames,
                 "Use of multicast: off, for discovery only, or also for data."),
    text_param("security", "", "Folder with certificates; enables DDS Security."),
    number_param("byte_rate", "B/s", 0, 0, 1e12,
                 "Byte rate that all its communicators share; 0: no limit."),
    integer_param("max_packet_bytes", 1400, 64, 65000, "Longest packet, with its header."),
    integer_param("queue_bytes", 1'048'576, 65'536, 1'000'000'000,
                  "Bytes of packets that may wait to be sent; further packets are lost."),
};

/// Sends packets as samples of `rave/radio`, through the air that all robots of the process share.
class DdsTransmitter final : public Transmitter {
 public:
  ~DdsTransmitter() override { close(); }

  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override {
    RAVE_TRY_ASSIGN(const AirOptions options, read_options(setup));
    // Joined here, before the run begins, because discovery takes some time.
    RAVE_TRY_ASSIGN(air_, Air::join(options));
    place_.host = setup.host;
    place_.network = radio_name_hash(options.network);
    network_ = options.network;
    declaration.max_packet_bytes = static_cast<std::uint32_t>(options.max_packet_bytes);
    declaration.byte_rate = setup.parameters().number("byte_rate");
    declaration.network = place_.network;
    declaration.boot = line::boot_number();
    return {};
  }

  Status open(PacketSink& sink) override {
    if (!air_) return fail(ErrorCode::kState, "opened before it was configured");
    if (place_.sink != nullptr) return fail(ErrorCode::kState, "opened twice; close it first");
    place_.sink = &sink;
    Status attached = air_->attach(place_);
    if (!attached) place_.sink = nullptr;
    return attached;
  }

  Status send(std::span<const std::byte> packet) override { return air_->send(packet, place_); }

  void close() override {
    if (place_.sink == nullptr) return;
    air_->detach(place_);
    place_.sink = nullptr;
  }

  [[nodiscard]] std::string report() const override {
    if (!air_) return "{}";
    const AirCounts counts = air_->counts();
    nlohmann::ordered_json json;
    json["network"] = network_;
    json["others"] = counts.others;
    // Sums over all robots of this process.
    json["sent"] = counts.sent;
    json["not_sent"] = counts.not_sent;
    json["received"] = counts.received;
    json["refused"] = counts.refused;
    json["foreign"] = counts.foreign;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

 private:
  std::shared_ptr<Air> air_;
  AirPlace place_;
  std::string network_;
};

}  // namespace
}  // namespace rave::dds_transmitter

RAVE_PLUGIN("dds_transmitter") {
  rave::add_transmitter<rave::dds_transmitter::DdsTransmitter>(
      registry, {.name = "dds_transmitter",
                 .summary = "Carries messages over DDS to all robots of the same network.",
                 .params = rave::dds_transmitter::kParams,
                 .clock = rave::DriverClock::kLive});
}
