// SPDX-License-Identifier: Apache-2.0
// A program that sends its number to all, counts what it hears, and says so at the end.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <rave/robot/plugin_entry.hpp>

namespace {

class Greeter final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    setup_.emplace(setup);
    RAVE_TRY_ASSIGN(radio_, setup.communicator("radio"));
    return {};
  }

  void decide(const rave::Percepts& percepts, rave::Commands& commands) override {
    commands.send(radio_, setup_->own_id());
    for (const rave::Message message : percepts.messages(radio_)) ++heard_[message.from];
    if (++decisions_ != kDecisions) return;
    for (const auto& [from, count] : heard_) {
      setup_->log(fmt::format("heard {} of {} messages of robot {}", count, kDecisions, from));
    }
  }

 private:
  static constexpr int kDecisions = 1000;
  std::optional<rave::Setup> setup_;
  rave::CommunicatorHandle radio_;
  std::map<std::uint32_t, int> heard_;
  int decisions_ = 0;
};

}  // namespace

RAVE_PLUGIN("greeter") {
  rave::add_program<Greeter>(registry, {.name = "greeter", .summary = "Counts whom it hears."});
}
