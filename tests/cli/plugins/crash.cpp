// SPDX-License-Identifier: Apache-2.0
// A program that crashes when its robot decides for the third time. Not installed.
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

class Crash final : public DecisionProcess {
 public:
  Status start(const Setup& /*setup*/) override { return {}; }
  void decide(const Percepts& /*percepts*/, Commands& /*commands*/) override {
    if (++decisions_ == 3) *nothing_ = 1;
  }

 private:
  int decisions_ = 0;
  volatile int* volatile nothing_ = nullptr;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("crash") {
  rave::add_program<rave::Crash>(registry, {.name = "crash", .summary = "Crashes."});
}
