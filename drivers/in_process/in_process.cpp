// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("byte_rate", "B/s", 0, 0, 1e12,
                 "Byte rate that all its communicators share; 0: no limit."),
};

/// Declares that the host delivers the messages itself.
class InProcess final : public Transmitter {
 public:
  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override {
    declaration.in_process = 1;
    declaration.byte_rate = setup.parameters().number("byte_rate");
    return {};
  }
  Status open(PacketSink&) override { return unused(); }
  Status send(std::span<const std::byte>) override { return unused(); }
  void close() override {}

 private:
  static Status unused() { return fail(ErrorCode::kState, "the host carries these messages"); }
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("in_process") {
  rave::add_transmitter<rave::InProcess>(
      registry, {.name = "in_process",
                 .summary = "Carries messages between robots of this host in simulation time.",
                 .params = rave::kParams});
}
