// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/message.hpp"
#include "rave/robot/radio_packet.hpp"

namespace rave {

/// Receives packets from the thread of a transmitter. Owned by the host; valid from open() until
/// close() has returned. Any thread of the driver, and the thread that calls send().
class PacketSink {
 public:
  /// Passes on one packet; the bytes are copied. If the queue is full, its oldest packet is lost
  /// and counted.
  virtual void receive(const std::byte* packet, std::uint64_t size) noexcept = 0;
  /// Reports that the device is lost; copies `text`.
  virtual void fail(const char* text, std::uint64_t size) noexcept = 0;
  /// Revokes fail(): the device is available again.
  virtual void recover() noexcept = 0;

 protected:
  ~PacketSink() = default;
};

/// Properties of a transmitter that follow from its parameters.
struct TransmitterDeclaration {
  /// 1: messages stay in the host, which delivers them in simulation time; open(), send() and
  /// close() are not called.
  std::uint32_t in_process = 0;
  std::uint32_t max_packet_bytes = 1400;
  /// Limit in bytes per second for all communicators together, which the host enforces before
  /// send(); 0: no limit, or the device limits itself.
  double byte_rate = 0;
  /// Devices only: packets with another number are ignored. Use radio_name_hash() of a name that is
  /// common to all members of the network.
  std::uint32_t network = 0;
  std::uint32_t boot = 0;  ///< Devices only: a number that differs after each start of the program.
};

/// A device that carries packets to and from other robots: a socket, a radio on a serial line. One
/// object per robot and entry of `transmitters:`. The engine's thread calls send(), which must
/// return at once: a slow line needs a queue and a thread of its own.
class Transmitter {
 public:
  virtual ~Transmitter() = default;
  virtual Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) = 0;
  /// Starts the driver's own thread, which writes to `sink`. An error prevents the start of the
  /// run.
  virtual Status open(PacketSink& sink) = 0;
  /// Sends one packet of rave/robot/radio_packet.hpp, which is opaque to the device. An error is
  /// counted; the packet is lost.
  virtual Status send(std::span<const std::byte> packet) = 0;
  /// Ends the thread and waits for it.
  virtual void close() = 0;
  /// Statistics of the device for the results of a run, as one JSON object (`{}` if none).
  [[nodiscard]] virtual std::string report() const { return "{}"; }
};

/// The function table of a transmitter, as the host calls it; made by add_transmitter().
struct TransmitterOps {
  InstanceOps instance;
  int (*configure)(void* instance, const HardwareSetup* setup, TransmitterDeclaration* declaration,
                   ErrorText* error) = nullptr;
  int (*open)(void* instance, PacketSink* sink, ErrorText* error) = nullptr;
  int (*send)(void* instance, const std::byte* packet, std::uint64_t size,
              ErrorText* error) = nullptr;
  void (*close)(void* instance) = nullptr;
  void (*report)(void* instance, void* context,
                 void (*take)(void* context, const char* text, std::uint64_t size)) = nullptr;
};

namespace detail {
template <class T>
constexpr TransmitterOps transmitter_ops() noexcept {
  TransmitterOps ops;
  ops.instance = instance_ops<T>();
  ops.configure = [](void* instance, const HardwareSetup* setup,
                     TransmitterDeclaration* declaration, ErrorText* error) {
    return guarded(error,
                   [&] { return static_cast<T*>(instance)->configure(*setup, *declaration); });
  };
  ops.open = [](void* instance, PacketSink* sink, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->open(*sink); });
  };
  ops.send = [](void* instance, const std::byte* packet, std::uint64_t size, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->send({packet, size}); });
  };
  ops.close = [](void* instance) { close_quietly<T>(instance); };
  ops.report = [](void* instance, void* context,
                  void (*take)(void* context, const char* text, std::uint64_t size)) {
    hand_over_report<T>(instance, context, take);
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
