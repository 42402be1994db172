// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    integer_param("count", 1, 0, 65535, "Messages in each decision."),
    number_param("from_s", "s", 1, 0, 1e6, "Time of the first ones."),
    number_param("until_s", "s", 11, 0, 1e6, "From then on it is silent."),
};

/// Counts aloud: each of its messages is the next number, to everyone.
class RollCall final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(radio_, setup.communicator());
    const Params params = setup.params();
    count_ = params.integer("count");
    from_ = from_seconds(params.number("from_s"));
    until_ = from_seconds(params.number("until_s"));
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    const std::int64_t now_ns = percepts.now().ns;
    if (now_ns < from_.ns || now_ns >= until_.ns) return;
    for (std::int64_t i = 0; i < count_; ++i) commands.send(radio_, ++number_);
  }

 private:
  CommunicatorHandle radio_;
  std::int64_t count_ = 0;
  Duration from_;
  Duration until_;
  std::uint32_t number_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("roll_call") {
  rave::add_program<rave::RollCall>(
      registry, {.name = "roll_call", .summary = "Counts aloud.", .params = rave::kParams});
}
