// SPDX-License-Identifier: Apache-2.0
// Runs the program on a robot made of plain values: no simulator, no host.
#include "@NAME@.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace {

// What the program commands when every ray of its sensor has read `range_m`, so long ago; `error` if
// it refuses.
rave::Command command_at(float range_m, double age_s, std::string& error) {
  const double bearings_rad[] = {-0.5, 0.0, 0.5};
  rave::SensorInfo laser;
  laser.name = "laser";
  laser.kind = rave::ReadingKind::kRanges;
  laser.capacity = 3;
  laser.bearings_rad = bearings_rad;
  laser.max_age_s = 0.3;
  rave::ControllerInfo drive;
  drive.name = "drive";
  drive.accepts = rave::CommandKind::kVelocity;
  rave::ParamValue params[2];
  params[0].name = "speed_mps";
  params[0].number = 0.2;
  params[1].name = "stop_m";
  params[1].number = 0.5;
  rave::ProgramSetup setup;
  setup.sensors = &laser;
  setup.sensor_count = 1;
  setup.controllers = &drive;
  setup.controller_count = 1;
  setup.params = params;
  setup.param_count = 2;

  const float ranges_m[] = {range_m, range_m, range_m};
  rave::SampleHeader header;
  header.sequence = 1;
  header.count = 3;
  const rave::SensorView view{&header, ranges_m};
  rave::Command command;
  rave::DecideItem item;
  item.sensors = &view;
  item.now_ns = static_cast<std::int64_t>(age_s * 1e9);
  item.commands = &command;

  @CLASS@ program;
  const rave::Status started = program.start(rave::Setup(setup));
  if (!started) {
    error = started.error().text();
    return command;
  }
  rave::Commands commands(item);
  program.decide(rave::Percepts(item), commands);
  return command;
}

// Empty if the program does what it should.
std::string problem() {
  std::string error;
  const rave::Command far = command_at(5.0F, 0.0, error);
  const rave::Command near = command_at(0.2F, 0.0, error);
  const rave::Command old = command_at(5.0F, 1.0, error);
  const float unknown_m = std::numeric_limits<float>::quiet_NaN();
  const rave::Command blind = command_at(unknown_m, 0.0, error);
  if (!error.empty()) return error;
  if (far.value[0] <= 0) return "it does not drive although nothing is near";
  if (near.value[0] != 0) return "it drives although something is near";
  if (old.value[0] != 0) return "it drives on what it saw a second ago";
  if (blind.value[0] != 0) return "it drives although no ray was measured";
  return "";
}

}  // namespace

#if defined(WITH_GTEST)
#include <gtest/gtest.h>
TEST(@CLASS@, DrivesAndStops) { EXPECT_EQ(problem(), ""); }
#else
#include <cstdio>
int main() {
  std::puts(problem().c_str());
  return problem().empty() ? 0 : 1;
}
#endif
