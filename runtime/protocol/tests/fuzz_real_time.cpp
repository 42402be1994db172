// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as worlds, messages of robots and obstacles, all the way into the world of
// a host: deserialiser, validation, reading, and steps of that world. The first byte says what
// comes; a step is made after each.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/live_world.hpp"

namespace {

using namespace rave;

sim::EngineSpec four_robots() {
  sim::EngineSpec spec;
  for (std::uint32_t r = 0; r < 4; ++r) {
    sim::RobotType type;
    type.simulated = r != 3;
    if (!type.simulated) type.pose_from = 0;
    type.communicators.resize(2);
    spec.types.push_back(std::move(type));
    world::Body body;
    body.shapes.push_back(world::make_disc({}, 0.2, 0, 0.3).value());
    spec.world.robots.push_back(std::move(body));
    spec.robots.push_back({"r", "", r, {1.0 * r, 0, 0}});
  }
  spec.local = {RobotId(0)};
  spec.own_authority = true;
  return spec;
}

void receive_world(real_time::LiveWorld& live, std::span<const std::byte> bytes, bool swapped) {
  bus::testing::Decoded<bus::World> decoded;
  if (!decoded.decode(bytes, swapped) || !bus::validate(decoded.sample())) return;
  for (std::size_t i = 0; i < decoded.sample().robots.id._length; ++i) {
    live.see(real_time::read_robot(decoded.sample().robots, i, Duration{12'345}));
  }
}

void receive_packet(real_time::LiveWorld& live, std::span<const std::byte> bytes, bool swapped) {
  bus::testing::Decoded<bus::Packet> decoded;
  if (!decoded.decode(bytes, swapped) || !bus::validate(decoded.sample())) return;
  const bus::Packet& packet = decoded.sample();
  live.hear(packet.writer, real_time::read_packet(packet, Duration{-12'345}),
            real_time::payload_of(packet));
}

void receive_obstacle(real_time::LiveWorld& live, std::span<const std::byte> bytes, bool swapped) {
  bus::testing::Decoded<bus::Obstacle> decoded;
  if (!decoded.decode(bytes, swapped) || !bus::validate(decoded.sample())) return;
  auto sight = real_time::read_obstacle(decoded.sample());
  if (sight) live.see(*std::move(sight));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  auto live = real_time::LiveWorld::create(four_robots());
  if (!live) std::abort();
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  const bool swapped = (data[0] & 0x80U) != 0;
  sim::HostReport own;
  sim::WorldStep world;
  for (std::uint64_t step = 0; step < 3; ++step) {
    if ((data[0] & 2U) != 0) {
      receive_obstacle(**live, bytes, swapped);
    } else {
      ((data[0] & 1U) != 0 ? receive_world : receive_packet)(**live, bytes, swapped);
    }
    own.begin(step);
    if (step > 0) own.proposals = {{0}, {1}, {0}, {0}};
    // Whatever others say, the own world goes on.
    if (!(*live)->step(own, world)) std::abort();
  }
  return 0;
}
