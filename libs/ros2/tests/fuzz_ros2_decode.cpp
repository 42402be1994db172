// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as messages of every kind that is read: the first byte chooses the kind
// and the byte order, the rest goes through the deserialiser and the validation, as in a reader.
#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/bus_testing/cdr.hpp"
#include "rave/math/geodesy.hpp"
#include "rave/ros2/convert.hpp"
#include "rave/ros2/validate.hpp"

namespace {

using namespace rave::ros2;

// What a driver does with a message that passed.
void use(const PoseStamped& message) { static_cast<void>(planar(message.pose)); }
void use(const Odometry& message) { static_cast<void>(planar(message.pose.pose)); }
void use(const TfMessage& message) {
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    static_cast<void>(planar(message.transforms._buffer[i]));
  }
}
void use(const NavSatFix& message) {
  static const rave::GeoFrame kFrame({47, 8, 400});
  if (message.status.status < 0) return;
  static_cast<void>(kFrame.world_point({message.latitude, message.longitude, message.altitude}));
}
void use(const auto& /*message*/) {}

template <class Message>
void receive(std::span<const std::byte> bytes, bool swapped) {
  rave::bus::testing::DecodedAs<Message> decoded(descriptor_of<Message>());
  if (!decoded.decode(bytes, swapped)) return;
  if (validate(decoded.sample())) use(decoded.sample());
}

using Receive = void (*)(std::span<const std::byte>, bool);
constexpr Receive kKinds[] = {receive<String>,       receive<PoseStamped>, receive<Twist>,
                              receive<TwistStamped>, receive<LaserScan>,   receive<RangeReading>,
                              receive<Imu>,          receive<NavSatFix>,   receive<BatteryState>,
                              receive<Odometry>,     receive<TfMessage>,   receive<Clock>,
                              receive<Range>};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  kKinds[(data[0] & 0x7fU) % std::size(kKinds)](bytes, (data[0] & 0x80U) != 0);
  return 0;
}
