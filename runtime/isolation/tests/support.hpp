// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "rave/isolation/isolated_program.hpp"
#include "rave/plugin/registry.hpp"

namespace rave::isolation {

inline std::filesystem::path plugin_file(const std::string& name) {
  return std::filesystem::path(RAVE_BINARY_DIR) / "tests/plugins/isolation" / (name + ".so");
}

inline IsolationOptions options_for(const std::string& plugin, const std::string& program) {
  IsolationOptions options;
  options.runner = std::filesystem::path(RAVE_BINARY_DIR) / "bin/rave-program-runner";
  options.plugin = plugin_file(plugin);
  options.program = program;
  options.decide_timeout_s = 60;  // Tests must not depend on the speed of the machine.
  options.start_timeout_s = 60;
  options.last_word_s = 60;
  return options;
}

/// `runtime/isolation/tests/plugins/faults.cpp:LINE` of the line with the comment `mark: NAME`.
inline int line_of(const std::string& mark) {
  std::ifstream file(std::string(RAVE_SOURCE_DIR) + "/runtime/isolation/tests/plugins/faults.cpp");
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    if (text.ends_with("// mark: " + mark)) return line;
  }
  ADD_FAILURE() << "no mark " << mark;
  return 0;
}
inline std::string place_of(const std::string& mark) {
  return "runtime/isolation/tests/plugins/faults.cpp:" + std::to_string(line_of(mark));
}

/// A robot with a laser, a camera and two controllers, and percepts that differ from decision to
/// decision. Keeps the log.
struct TestRobot {
  explicit TestRobot(std::string robot_name = "anna") : name(std::move(robot_name)) {
    sensors[0].name = "laser";
    sensors[0].kind = ReadingKind::kRanges;
    sensors[0].capacity = 4;
    sensors[0].X_RS = {0.125, 0, 0.5};
    sensors[0].bearings_rad = bearings_rad.data();
    sensors[1].name = "camera";
    sensors[1].kind = ReadingKind::kSightings;
    sensors[1].capacity = 3;
    controllers[0] = {"drive", CommandKind::kVelocity, 0};
    controllers[1] = {"goal", CommandKind::kGoal, 0};
    communicators[0] = {"air", 3, 40, 16, 0};
    params[0].name = "gain";
    params[0].number = 0.75;
    params[1].name = "greeting";
    params[1].text = "hello";
    params[2].name = "weights";
    params[2].list = weights.data();
    params[2].list_size = weights.size();
  }

  ProgramSetup setup() {
    ProgramSetup setup;
    setup.robot.name = name.c_str();
    setup.robot.team = "blue";
    setup.robot.id = 7;
    setup.robot.radius_m = 0.2;
    setup.robot.seed = 11;
    setup.host = {this, [](void* context, LogLevel, const char* text, std::uint64_t size) {
                    static_cast<TestRobot*>(context)->log.emplace_back(text, size);
                  }};
    setup.sensors = sensors.data();
    setup.sensor_count = sensors.size();
    setup.controllers = controllers.data();
    setup.controller_count = controllers.size();
    setup.params = params.data();
    setup.param_count = params.size();
    setup.period_s = 0.1;
    setup.communicators = communicators.data();
    setup.communicator_count = communicators.size();
    setup.robot_names = robot_names.data();
    setup.robot_count = robot_names.size();
    return setup;
  }

  /// Percepts of decision `k`; commands stay as they are.
  DecideItem item(std::uint32_t k) {
    headers[0] = {k * 1000, k, k % 5, 1, 0};
    headers[1] = {k * 1000, k, k % 4, 1, 2};
    for (std::uint32_t i = 0; i < 4; ++i) ranges[i] = 0.1F * static_cast<float>(k + i);
    if (k % 3 == 0) ranges[2] = std::numeric_limits<float>::infinity();
    if (k % 7 == 0) ranges[2] = 1;
    for (std::uint32_t i = 0; i < 3; ++i) {
      sightings[i] = {k, static_cast<std::int32_t>(i + k), 1, 0.01F * static_cast<float>(k), 0};
    }
    views[0] = {&headers[0], ranges.data()};
    views[1] = {&headers[1], sightings.data()};
    in.clear();
    out.clear();
    for (std::uint32_t i = 0; i < k % 4; ++i) {
      const std::uint32_t words[] = {k, i, k * i};
      in.put({k, i, i + 1, Recipient::one(7), 0, 0},
             std::as_bytes(std::span(words).first(1 + (k + i) % 3)));
    }
    DecideItem item;
    item.communicators = &communicator;
    item.sensors = views.data();
    item.commands = commands.data();
    item.now_ns = std::int64_t{k} * 100'000'000;
    item.pose.x_m = 0.001 * k;
    item.decision = k;
    item.robot = 7;
    item.seed = 11;
    return item;
  }

  std::string name;
  std::vector<double> bearings_rad{-0.3, -0.1, 0.1, 0.3};
  std::vector<double> weights{0.25, 0.5};
  std::vector<SensorInfo> sensors = std::vector<SensorInfo>(2);
  std::vector<ControllerInfo> controllers = std::vector<ControllerInfo>(2);
  std::vector<ParamValue> params = std::vector<ParamValue>(3);
  std::vector<CommunicatorInfo> communicators = std::vector<CommunicatorInfo>(1);
  std::vector<const char*> robot_names{"anna", "bert", "carl"};
  std::vector<rave::MessageHead> heads = std::vector<rave::MessageHead>(6);
  std::vector<std::byte> message_bytes = std::vector<std::byte>(80);
  Mailbox in{heads.data(), message_bytes.data(), 3, 40, 0, 0, 0, 0};
  Mailbox out{heads.data() + 3, message_bytes.data() + 40, 3, 40, 0, 0, 0, 0};
  CommunicatorView communicator{&in, &out};
  std::vector<SampleHeader> headers = std::vector<SampleHeader>(2);
  std::vector<float> ranges{0, 0, 0, 0};
  std::vector<Sighting> sightings = std::vector<Sighting>(3);
  std::vector<SensorView> views = std::vector<SensorView>(2);
  std::vector<Command> commands = std::vector<Command>(2);
  std::vector<std::string> log;
};

}  // namespace rave::isolation
