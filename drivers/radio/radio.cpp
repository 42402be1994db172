// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("range_m", "m", 0, 0, 1e6, "Range, between reported poses; 0: no limit."),
    bool_param("line_of_sight", false, "Whether bodies between shorten or block the range."),
    number_param("obstructed_range_m", "m", 0, 0, 1e6,
                 "Range through bodies, with line_of_sight; 0: blocked."),
    number_param("loss_probability", "", 0, 0, 1, "Share of messages that each receiver loses."),
    number_param("latency_s", "s", 0, 0, 60, "Time from the end of sending to arrival."),
    number_param("jitter_s", "s", 0, 0, 60, "Largest additional latency, uniformly distributed."),
    number_param("byte_rate", "B/s", 0, 0, 1e12, "Byte rate; 0: no limit."),
    integer_param("overhead_bytes", 0, 0, 65535,
                  "Bytes sent with each message in addition to its own."),
    integer_param("queue_bytes", 65536, 0, 1'000'000'000,
                  "Bytes that may wait to be sent, overhead included; 0: no limit."),
    integer_param("max_message_bytes", 256, 1, 65535, "Longest message."),
    integer_param(
        "mailbox_messages", 64, 1, 65535,
        "Largest number of messages per decision, sent and received alike; further ones are lost."),
    integer_param("mailbox_bytes", 8192, 1, 16'777'216,
                  "Largest number of bytes of these messages together."),
    number_param("antenna_z_m", "m", 0.1, -100, 1000, "Height of the antenna above the floor."),
};

/// Limited range, line of sight, loss and latency; see README.md.
class Radio final : public Communicator {
 public:
  Status start(const DeviceSetup& setup, RadioDeclaration& declaration) override {
    const Params params = setup.parameters();
    const auto whole = [&](const char* name) {
      return static_cast<std::uint32_t>(params.integer(name));
    };
    declaration.range_m = params.number("range_m");
    declaration.line_of_sight = params.flag("line_of_sight") ? 1 : 0;
    declaration.byte_rate = params.number("byte_rate");
    declaration.overhead_bytes = whole("overhead_bytes");
    declaration.max_queue_bytes = whole("queue_bytes");
    declaration.max_message_bytes = whole("max_message_bytes");
    declaration.max_messages = whole("mailbox_messages");
    // A mailbox that cannot hold the longest message would lose it always.
    declaration.max_mailbox_bytes = std::max(whole("mailbox_bytes"), declaration.max_message_bytes);
    declaration.antenna_z_m = params.number("antenna_z_m");
    obstructed_range_m_ = params.number("obstructed_range_m");
    loss_probability_ = params.number("loss_probability");
    latency_s_ = params.number("latency_s");
    jitter_s_ = params.number("jitter_s");
    const std::uint64_t longest =
        std::uint64_t{declaration.max_message_bytes} + declaration.overhead_bytes;
    if (declaration.max_queue_bytes > 0 && declaration.max_queue_bytes < longest) {
      return fail(ErrorCode::kInvalidArgument,
                  "`queue_bytes` ({}) has no room for the longest message with its overhead ({})",
                  declaration.max_queue_bytes, longest);
    }
    return {};
  }

  [[nodiscard]] LinkAnswer link(const LinkQuery& query) const override {
    LinkAnswer answer;
    if (query.obstructed != 0 && query.distance_m > obstructed_range_m_) {
      answer.arrives = 0;
      return answer;
    }
    answer.delay_s = latency_s_;
    if (loss_probability_ == 0 && jitter_s_ == 0) return answer;
    RandomStream random = query.random();
    if (random.uniform() < loss_probability_) answer.arrives = 0;
    // Drawn also for a lost message, so that a change of one parameter does not shift the draws of
    // the other.
    answer.delay_s += jitter_s_ * random.uniform();
    return answer;
  }

 private:
  double obstructed_range_m_ = 0;
  double loss_probability_ = 0;
  double latency_s_ = 0;
  double jitter_s_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("radio") {
  rave::add_communicator<rave::Radio>(
      registry, {.name = "radio",
                 .summary = "Messages with range, line of sight, loss, latency and byte rate.",
                 .params = rave::kParams});
}
