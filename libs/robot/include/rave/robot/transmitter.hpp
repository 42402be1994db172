// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/message.hpp"
#include "rave/robot/radio_packet.hpp"

namespace rave {

/// Where the thread of a transmitter puts what it hears. Belongs to the host; valid from open()
/// until close() has returned. Any thread of the driver, and of the host in send().
class PacketSink {
 public:
  /// Hands over one packet; the bytes are copied. A full queue loses its oldest packet, counted.
  virtual void receive(const std::byte* packet, std::uint64_t size) noexcept = 0;
  /// Reports that the device is gone; `text` is copied.
  virtual void fail(const char* text, std::uint64_t size) noexcept = 0;
  /// The device is back after fail().
  virtual void recover() noexcept = 0;

 protected:
  ~PacketSink() = default;
};

/// What a transmitter says of itself once it knows its parameters.
struct TransmitterDeclaration {
  /// 1: messages never leave the host, which carries them itself in simulation time; open(),
  /// send() and close() are not called.
  std::uint32_t in_process = 0;
  std::uint32_t max_packet_bytes = 1400;
  /// Bytes a second of all communicators together, which the host enforces before it calls send();
  /// 0: no limit, or a device that keeps to one by itself.
  double byte_rate = 0;
  /// Of a device: only packets with this number are taken; radio_name_hash() of a name that those
  /// who belong together share.
  std::uint32_t network = 0;
  std::uint32_t boot = 0;  ///< Of a device: another number each time the program is started.
};

/// A device that carries packets to and from other robots: a socket, a radio on a serial line. One
/// object per robot and entry of `transmitters:`. send() is called from the engine's thread and
/// must return at once: a slow line has a queue and a thread of its own.
class Transmitter {
 public:
  virtual ~Transmitter() = default;
  virtual Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) = 0;
  /// Starts the driver's own thread, which writes to `sink`. An error keeps the run from starting.
  virtual Status open(PacketSink& sink) = 0;
  /// `packet` is one of rave/robot/radio_packet.hpp, a sequence of bytes for the device. An error
  /// is counted: that packet is lost.
  virtual Status send(std::span<const std::byte> packet) = 0;
  /// Ends the thread and waits for it.
  virtual void close() = 0;
  /// What an experimenter should know of it, as one JSON object (`{}` if nothing).
  [[nodiscard]] virtual std::string report() const { return "{}"; }
};

/// The functions of a transmitter as the host calls them; made by add_transmitter().
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
