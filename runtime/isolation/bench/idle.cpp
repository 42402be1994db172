// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"

namespace {
class Idle final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup&) override { return {}; }

  void decide(const rave::Percepts&, rave::Commands&) override {}
};
}  // namespace

RAVE_PLUGIN("idle") {
  rave::add_program<Idle>(registry, {.name = "idle", .summary = "Does nothing."});
}
