// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/hash.hpp"
#include "rave/base/random.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/message.hpp"

namespace rave {

/// What a communicator says of itself once it knows its parameters: the part of its message model
/// that the host works out for all robots at once. Rate, queue, overhead and sizes are those of the
/// sender. A message must be within the ranges of both sides; the line of sight is asked if either
/// side asks for it, at the mean height of both antennas.
struct RadioDeclaration {
  double range_m = 0;               ///< Between reported poses; 0: unlimited.
  std::uint32_t line_of_sight = 0;  ///< 1: bodies in between stop it or weaken it, see LinkQuery.
  std::uint32_t max_message_bytes = 1024;
  std::uint32_t max_messages = 32;  ///< Per decision, each direction.
  /// Waiting to be sent or being sent, overhead included; 0: unlimited. Newer ones are lost.
  std::uint32_t max_queue_bytes = 0;
  double byte_rate = 0;              ///< Bytes a second; 0: unlimited.
  std::uint32_t overhead_bytes = 0;  ///< Counted for each message besides its own.
  /// Of all messages of one decision, each direction; at least max_message_bytes.
  std::uint32_t max_mailbox_bytes = 8192;
  double antenna_z_m = 0.1;  ///< Height for the line of sight.
};

/// One message about to go from one robot to another that is in range. The model of the receiver is
/// asked, so that it is the same whatever carried the message.
struct LinkQuery {
  double distance_m = 0;         ///< Between reported poses.
  std::uint32_t obstructed = 0;  ///< 1: a body stands in between (if line_of_sight is asked).
  std::uint32_t bytes = 0;
  std::uint32_t from = 0;  ///< RobotId; of a sender that is no robot here the hash of its name.
  std::uint32_t to = 0;
  std::uint32_t sequence = 0;  ///< Of the message.
  std::uint32_t device = 0;    ///< Of the sender: its communicator, from kRadioDevice on.
  std::uint64_t seed = 0;

  /// Numbers that devices of other kinds do not draw under.
  static constexpr std::uint32_t kRadioDevice = 0x2000'0000U;

  /// Random numbers of this delivery.
  [[nodiscard]] RandomStream random() const noexcept {
    const std::uint64_t message = mix64((std::uint64_t{from} << 32U) | sequence);
    return {seed, to, device, static_cast<std::uint32_t>(message)};
  }
};

/// What becomes of one message on its way to one robot.
struct LinkAnswer {
  std::uint32_t arrives = 1;
  std::uint32_t reserved = 0;
  double delay_s = 0;  ///< From the end of sending to arrival, at least 0; rounded up to steps.
};

/// A message model: who hears what, and when. One object serves all robots that use the driver
/// with the same parameters; link() may run in several threads at once, so it is const.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual Status start(const DeviceSetup& setup, RadioDeclaration& declaration) = 0;
  [[nodiscard]] virtual LinkAnswer link(const LinkQuery& query) const = 0;
};

/// The functions of a message model as the host calls them; made by add_communicator().
struct CommunicatorOps {
  InstanceOps instance;
  int (*start)(void* instance, const DeviceSetup* setup, RadioDeclaration* declaration,
               ErrorText* error) = nullptr;
  int (*link)(const void* instance, const LinkQuery* queries, LinkAnswer* answers,
              std::uint64_t count, ErrorText* error) = nullptr;
};

namespace detail {
template <class T>
constexpr CommunicatorOps communicator_ops() noexcept {
  CommunicatorOps ops;
  ops.instance = instance_ops<T>();
  ops.start = [](void* instance, const DeviceSetup* setup, RadioDeclaration* declaration,
                 ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->start(*setup, *declaration); });
  };
  ops.link = [](const void* instance, const LinkQuery* queries, LinkAnswer* answers,
                std::uint64_t count, ErrorText* error) {
    return guarded(error, [&]() -> Status {
      for (std::size_t i = 0; i < count; ++i) {
        answers[i] = static_cast<const T*>(instance)->T::link(queries[i]);
      }
      return {};
    });
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
