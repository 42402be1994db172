// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/hash.hpp"
#include "rave/base/random.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/message.hpp"

namespace rave {

/// The part of a communicator's message model that the host computes for all robots at once; the
/// communicator fills it in start(). Rate, queue, overhead and sizes apply to the sender. A message
/// must be within the ranges of both sides. The line of sight is checked if either side requires
/// it, at the mean height of both antennas.
struct RadioDeclaration {
  double range_m = 0;  ///< Range between reported poses; 0: unlimited.
  /// 1: bodies between the robots block or weaken a message, see LinkQuery.
  std::uint32_t line_of_sight = 0;
  std::uint32_t max_message_bytes = 1024;
  std::uint32_t max_messages = 32;  ///< Per decision and direction.
  /// Limit of the bytes waiting or being sent, overhead included; 0: unlimited. New messages beyond
  /// it are lost.
  std::uint32_t max_queue_bytes = 0;
  double byte_rate = 0;              ///< Bytes per second; 0: unlimited.
  std::uint32_t overhead_bytes = 0;  ///< Added to each message.
  /// Limit for all messages of one decision, per direction; at least max_message_bytes.
  std::uint32_t max_mailbox_bytes = 8192;
  double antenna_z_m = 0.1;  ///< Height of the antenna for the line of sight.
};

/// A message from one robot to another in range. The host asks the model of the receiver, so the
/// result does not depend on the transmitter.
struct LinkQuery {
  double distance_m = 0;         ///< Distance between reported poses.
  std::uint32_t obstructed = 0;  ///< 1: a body is in between (only if line_of_sight is required).
  std::uint32_t bytes = 0;
  std::uint32_t from = 0;  ///< RobotId; for a sender outside of this run, the hash of its name.
  std::uint32_t to = 0;
  std::uint32_t sequence = 0;  ///< Sequence number of the message.
  std::uint32_t device = 0;    ///< Communicator of the sender, counted from kRadioDevice.
  std::uint64_t seed = 0;

  /// Device number of the first communicator for random streams; other devices have lower numbers.
  static constexpr std::uint32_t kRadioDevice = 0x2000'0000U;

  /// The random numbers for this delivery.
  [[nodiscard]] RandomStream random() const noexcept {
    const std::uint64_t message = mix64((std::uint64_t{from} << 32U) | sequence);
    return {seed, to, device, static_cast<std::uint32_t>(message)};
  }
};

/// The fate of one message to one robot.
struct LinkAnswer {
  std::uint32_t arrives = 1;
  std::uint32_t reserved = 0;
  /// Time from the end of sending to arrival, at least 0; rounded up to steps.
  double delay_s = 0;
};

/// A message model: who receives a message, and when. One object serves all robots with the same
/// driver and parameters. Several threads may call link() at once, so it is const.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual Status start(const DeviceSetup& setup, RadioDeclaration& declaration) = 0;
  [[nodiscard]] virtual LinkAnswer link(const LinkQuery& query) const = 0;
};

/// The function table of a message model, as the host calls it; made by add_communicator().
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
    return guarded(error, [&] {
      for (std::size_t i = 0; i < count; ++i) {
        answers[i] = static_cast<const T*>(instance)->T::link(queries[i]);
      }
    });
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
