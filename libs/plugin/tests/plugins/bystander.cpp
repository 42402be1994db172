// SPDX-License-Identifier: Apache-2.0
// A good plug-in that is built several times with different versions.
#include "rave/robot/plugin_entry.hpp"

namespace {
constexpr int kOps = 0;
}

RAVE_PLUGIN("bystander") {
  const rave::Description description{
      .name = "bystander", .version = TEST_VERSION, .summary = "Stands by."};
  registry.add(description.info(rave::DriverKind::kController, 0), &kOps);
}
