// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble_testing/host_fixture.hpp"

namespace rave::runtime::testing {
namespace {

std::string one(const std::string& devices, const std::string& place = "pose: {x_m: 0, y_m: 0}") {
  return scenario_text("  - name: anna\n    " + place + "\n    robot: {" + kBody + ", " + devices +
                       "}\n");
}

TEST(Build, TakesAGoodScenario) {
  Host host;
  EXPECT_EQ(host.error_of(one(kWheels)), "none");
  const auto built = host.build_text(
      one("sensors: [{name: laser, driver: virtual_laser, period_s: 0.1, phase_s: 0.02, mount: "
          "{z_m: 0.1}, senses: [mapped_real]}], " +
              kWheels + ", program: {driver: wander, period_s: 0.05}",
          "pose: {x_m: 1, y_m: 2, yaw_deg: 90}"));
  ASSERT_TRUE(built.has_value()) << built.error().text();
  const sim::RobotType& type = built->spec.types.at(0);
  EXPECT_TRUE(type.simulated);
  EXPECT_EQ(type.sensors.at(0).period_steps, 10U);
  EXPECT_EQ(type.sensors.at(0).phase_steps, 2U);
  EXPECT_EQ(type.sensors.at(0).layers, static_cast<LayerMask>(Layer::kMappedReal));
  EXPECT_EQ(type.program->period_steps, 5U);
  EXPECT_EQ(built->spec.robots.at(0).X_WR.x, 1);
  EXPECT_NEAR(built->spec.robots.at(0).X_WR.yaw, 1.5707963267948966, 1e-15);
}

TEST(BuildErrors, AnUnknownDriverNamesTheNearestAndWhereOwnOnesGo) {
  Host host;
  const std::string error =
      host.error_of(one("sensors: [{name: eye, driver: virtual_lazer}], " + kWheels));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("`virtual_lazer`"), std::string::npos) << error;
  EXPECT_NE(error.find("virtual_laser"), std::string::npos) << error;
  EXPECT_NE(error.find("--plugins or RAVE_PLUGIN_PATH"), std::string::npos) << error;
}

TEST(BuildErrors, AParameterThatIsWrongPointsAtItsPlace) {
  Host host;
  const std::string range = host.error_of(
      one("sensors: [{name: eye, driver: virtual_laser, params: {range_max_m: -1}}], " + kWheels));
  EXPECT_EQ(range.find("s.yaml:6:"), 0U) << range;
  EXPECT_NE(range.find("`range_max_m`"), std::string::npos) << range;
  const std::string name = host.error_of(
      one("sensors: [{name: eye, driver: virtual_laser, params: {rayz: 5}}], " + kWheels));
  EXPECT_EQ(name.find("s.yaml:6:"), 0U) << name;
  EXPECT_NE(name.find("`rayz`"), std::string::npos) << name;
  EXPECT_NE(name.find("`rays`"), std::string::npos) << name;
}

const std::string kBase = "devices: [{name: base, driver: create_oi, params: {device: /dev/x}}], ";

TEST(Build, PartsOfADeviceNameIt) {
  Host host;
  const auto built = host.build_text(
      one(kBase + "pose_from: wheels, sensors: [{name: wheels, driver: create_odometry, device: "
                  "base}], actuators: [{name: motors, driver: create_drive, device: base}]"));
  ASSERT_TRUE(built.has_value()) << built.error().text();
  const sim::RobotType& type = built->spec.types.at(0);
  EXPECT_FALSE(type.simulated);
  EXPECT_EQ(type.devices.at(0).name, "base");
  EXPECT_EQ(type.devices.at(0).driver, "create_oi");
  EXPECT_EQ(type.sensors.at(0).device, 0U);
  EXPECT_EQ(type.actuators.at(0).device, 0U);
  EXPECT_NE(built->live_reason.find("`base`"), std::string::npos) << built->live_reason;
}

/// A robot of ROS 2 that drives, with one more sensor.
std::string cart(const std::string& sensor, const std::string& drive =
                                                ", actuators: [{name: motors, driver: "
                                                "ros2_velocity, device: base}]") {
  return one(
      "devices: [{name: base, driver: ros2}], pose_from: pose, sensors: [{name: pose, "
      "driver: ros2_pose, device: base}, " +
      sensor + "]" + drive);
}

TEST(Build, ASensorIsGivenItsLargestAgeAndWhenItsSamplesCome) {
  Host host;
  const auto built =
      host.build_text(cart("{name: eye, driver: ros2_laser, device: base, max_age_s: 0.5}, "
                           "{name: command, driver: ros2_command, device: base}, {name: scanner, "
                           "driver: scip_laser, params: {device: /dev/x}}"));
  ASSERT_TRUE(built.has_value()) << built.error().text();
  const auto& sensors = built->spec.types.at(0).sensors;
  EXPECT_EQ(sensors.at(0).max_age_s, std::nullopt);
  EXPECT_EQ(sensors.at(1).max_age_s, 0.5);
  EXPECT_EQ(sensors.at(1).timing, SampleTiming::kUnknown);
  EXPECT_EQ(sensors.at(2).timing, SampleTiming::kEvents);
  EXPECT_EQ(sensors.at(3).timing, SampleTiming::kPeriodic);
}

TEST(BuildErrors, ARangeSensorOfUnknownPaceNeedsALargestAgeIfItsRobotDrives) {
  const std::string expected =
      "robot `anna` is real, and the driver `ros2_laser` of its range sensor `eye` does not know "
      "its period: expected `max_age_s`, the age of the newest sample in seconds after "
      "which the robot is stopped, such as three periods of the sensor (`max_age_s: 0.3` at 10 Hz)";
  Host host;
  const std::string plain = "{name: eye, driver: ros2_laser, device: base}";
  const std::string error = host.error_of(cart(plain));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find(expected), std::string::npos) << error;
  const std::string hybrid = host.error_of(
      cart("{name: eye, driver: hybrid_ranges, real: {driver: ros2_laser, device: base}, virtual: "
           "{driver: virtual_laser, params: {rays_of_real_half: true}}}"));
  EXPECT_NE(hybrid.find(expected), std::string::npos) << hybrid;
  EXPECT_EQ(host.error_of(cart(plain, "")), "none") << "it cannot drive";
  EXPECT_EQ(host.error_of(cart("{name: accu, driver: ros2_battery, device: base}")), "none");
}

TEST(BuildErrors, AVirtualSensorHasNoLargestAge) {
  Host host;
  const std::string error =
      host.error_of(one("sensors: [{name: eye, driver: virtual_laser, max_age_s: 1}], " + kWheels));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("`max_age_s` is for real sensors; the driver `virtual_laser` of sensor "
                       "`eye` is virtual"),
            std::string::npos)
      << error;
  EXPECT_NE(host.error_of(cart("{name: eye, driver: ros2_laser, device: base, max_age_s: 0}")),
            "none");
}

TEST(Build, ADriverLearnsWhereTheWorldLiesUnlessItsFileSaysSo) {
  const auto origin_of = [](const std::string& params) {
    Host host;
    const auto built = host.build_text(
        one("devices: [{name: base, driver: ros2}], pose_from: gps, sensors: [{name: gps, driver: "
            "ros2_gps, device: base" +
            params + "}]") +
        "geo_origin: {latitude_deg: 47.5, longitude_deg: 8.5, yaw_deg: 30}\n");
    EXPECT_TRUE(built.has_value()) << built.error().text();
    const auto numbers =
        Params(built->spec.types.at(0).sensors.at(0).params.values()).numbers("geo_origin");
    return std::vector<double>(numbers.begin(), numbers.end());
  };
  EXPECT_EQ(origin_of(""), (std::vector<double>{47.5, 8.5, 0, 30}));
  EXPECT_EQ(origin_of(", params: {antenna_x_m: 0.5}"), (std::vector<double>{47.5, 8.5, 0, 30}));
  EXPECT_EQ(origin_of(", params: {geo_origin: [1, 2]}"), (std::vector<double>{1, 2}));
}

TEST(BuildErrors, APartOfADeviceNeedsOneOfItsDriver) {
  Host host;
  EXPECT_EQ(host.error_of(one("sensors: [{name: wheels, driver: create_odometry}]")),
            "s.yaml:6:102: the driver `create_odometry` is part of a device: expected `device:` "
            "with the name of an entry of `devices:` that has the driver `create_oi`; the robot "
            "has none");
  EXPECT_EQ(host.error_of(one(kBase + "actuators: [{name: motors, driver: create_drive}]")),
            "s.yaml:6:174: the driver `create_drive` is part of a device: expected `device:` with "
            "the name of an entry of `devices:` that has the driver `create_oi`; there is base");
  EXPECT_EQ(
      host.error_of(one(kBase + "sensors: [{name: eye, driver: virtual_laser, device: "
                                "base}]")),
      "s.yaml:6:192: the driver `virtual_laser` does not use a device: expected no `device:`");
  const std::string unknown = host.error_of(
      one(kBase + "sensors: [{name: wheels, driver: create_odometry, device: bass}]"));
  EXPECT_EQ(unknown.find("s.yaml:6:"), 0U) << unknown;
  EXPECT_NE(unknown.find("did you mean `base`"), std::string::npos) << unknown;
}

TEST(BuildErrors, ADeviceIsOfADriverThatIsADevice) {
  Host host;
  const std::string error = host.error_of(
      one("devices: [{name: base, driver: create_of}], sensors: [{name: wheels, driver: "
          "create_odometry, device: base}]"));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("there is no device `create_of`; did you mean `create_oi`?"),
            std::string::npos)
      << error;
}

TEST(Build, TakesARadio) {
  Host host;
  const auto built = host.build_text(
      one("transmitters: [{name: air, driver: in_process}], communicators: [{name: chat, driver: "
          "radio, transmitter: air, params: {range_m: 5}}], " +
          kWheels));
  ASSERT_TRUE(built.has_value()) << built.error().text();
  const sim::RobotType& type = built->spec.types.at(0);
  EXPECT_EQ(type.transmitters.at(0).driver, "in_process");
  EXPECT_EQ(type.communicators.at(0).name, "chat");
  EXPECT_EQ(type.communicators.at(0).transmitter, 0U);
  EXPECT_EQ(built->live_reason, "");
}

TEST(Build, ATransmitterOfTheRealWorldMakesTheRunLive) {
  Host host;
  const auto built = host.build_text(one(
      "transmitters: [{name: wlan, driver: udp_transmitter, params: {port: 4711}}], " + kWheels));
  ASSERT_TRUE(built.has_value()) << built.error().text();
  EXPECT_NE(built->live_reason.find("`wlan`"), std::string::npos) << built->live_reason;
}

TEST(Build, KnowsWhoLooksAtOthers) {
  Host host;
  const auto sees = [&](const std::string& devices) {
    const auto built = host.build_text(one(devices));
    EXPECT_TRUE(built.has_value()) << built.error().text();
    if (!built) return -1;
    EXPECT_EQ(needs_manager(*built), built->sees.at(0) != 0);
    return int{built->sees.at(0)};
  };
  EXPECT_EQ(sees(kWheels), 0);
  EXPECT_EQ(sees("sensors: [{name: eye, driver: virtual_laser}], " + kWheels), 1);
  EXPECT_EQ(sees("guard: {max_speed_mps: 1}, " + kWheels), 0);
  EXPECT_EQ(sees("guard: {separation_m: 0.1}, " + kWheels), 1);
}

TEST(Build, AScenarioMayWantRealTime) {
  Host host;
  const auto built = host.build_text(one(kWheels) + "clock: real_time\n");
  ASSERT_TRUE(built.has_value()) << built.error().text();
  EXPECT_EQ(built->live_reason, "the scenario says `clock: real_time`");
}

TEST(BuildErrors, ARadioThatIsWrongPointsAtItsPlace) {
  Host host;
  const auto error_of = [&](const std::string& devices) {
    return host.error_of(one(devices + ", " + kWheels));
  };
  const std::string air = "transmitters: [{name: air, driver: in_process}], ";
  const std::string driver =
      error_of(air + "communicators: [{name: chat, driver: radyo, transmitter: air}]");
  EXPECT_EQ(driver.find("s.yaml:6:"), 0U) << driver;
  EXPECT_NE(driver.find("`radio`"), std::string::npos) << driver;
  const std::string transmitter =
      error_of(air + "communicators: [{name: chat, driver: radio, transmitter: aire}]");
  EXPECT_EQ(transmitter.find("s.yaml:6:"), 0U) << transmitter;
  EXPECT_NE(transmitter.find("`air`"), std::string::npos) << transmitter;
  const std::string param = error_of(
      air + "communicators: [{name: chat, driver: radio, transmitter: air, params: {range: 5}}]");
  EXPECT_EQ(param.find("s.yaml:6:"), 0U) << param;
  EXPECT_NE(param.find("`range_m`"), std::string::npos) << param;
}

TEST(BuildErrors, ARealRobotMustSayWhereItIs) {
  Host host;
  const std::string deaf =
      "actuators: [{name: wheels, driver: replay_ignored}], controllers: [{name: drive, driver: "
      "velocity, actuator: wheels}]";
  const std::string silent = host.error_of(one(deaf));
  EXPECT_EQ(silent.find("s.yaml:6:"), 0U) << silent;
  EXPECT_NE(silent.find("robot `anna` is real, so others can sense it only if its pose is known: "
                        "expected `pose_from:` with the name of a sensor that gives a pose "
                        "or odometry"),
            std::string::npos)
      << silent;
  const std::string circular = host.error_of(
      one(deaf + ", sensors: [{name: gps, driver: indoor_positioning}], pose_from: gps"));
  EXPECT_NE(circular.find("robot `anna` is real, so `pose_from` needs a real sensor, but `gps` "
                          "(driver `indoor_positioning`) is virtual"),
            std::string::npos)
      << circular;
}

TEST(BuildErrors, PoseFromNeedsAPose) {
  Host host;
  const std::string error = host.error_of(
      one("sensors: [{name: eye, driver: virtual_laser}], pose_from: eye, " + kWheels));
  EXPECT_NE(error.find("`pose_from` needs a sensor that gives a pose or odometry, but `eye` gives "
                       "ranges"),
            std::string::npos)
      << error;
}

TEST(BuildErrors, SensesIsForVirtualSensors) {
  Host host;
  const std::string error = host.error_of(
      one("sensors: [{name: mocap, driver: utias_mocap, senses: [mapped_real], params: {folder: x, "
          "robot: 1}}], pose_from: mocap"));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("`senses` is for virtual sensors; the driver `utias_mocap` of sensor "
                       "`mocap` is real"),
            std::string::npos)
      << error;
}

TEST(BuildErrors, OneActuatorMovesABody) {
  Host host;
  const std::string two =
      host.error_of(one("actuators: [{name: a, driver: differential_drive}, {name: b, driver: "
                        "differential_drive}]"));
  EXPECT_NE(two.find("actuators `a` and `b` both move the body; expected one that does"),
            std::string::npos)
      << two;
  const std::string mixed = host.error_of(
      one("actuators: [{name: a, driver: differential_drive}, {name: b, driver: replay_ignored}]"));
  EXPECT_NE(mixed.find("actuator `a` is simulated and `b` is real; expected all of one kind"),
            std::string::npos)
      << mixed;
}

TEST(BuildErrors, ARobotThatStartsInsideSomethingIsToldWhatAndHowDeep) {
  Host host;
  const std::string error = host.error_of(scenario_text(
      "  - {name: anna, pose: {x_m: 0.6, y_m: 0}, robot: {" + kBody + ", " + kWheels + "}}\n",
      "obstacles: [{name: crate, box_m: [1, 1], x_m: 0, y_m: 0, z_m: [0, 1]}]\n"));
  EXPECT_NE(error.find("robot `anna` starts inside `crate` (0.050 m deep); expected a free place"),
            std::string::npos)
      << error;
  const std::string twins =
      host.error_of(scenario_text("  - {name: anna, poses: [[0, 0, 0], [0.2, 0, 0]], robot: {" +
                                  kBody + ", " + kWheels + "}}\n"));
  EXPECT_NE(twins.find("robot `anna-2` starts inside `anna-1` (0.100 m deep)"), std::string::npos)
      << twins;
}

TEST(BuildErrors, ASimulatedRobotMustBePutSomewhere) {
  Host host;
  const std::string error =
      host.error_of(scenario_text("  - {name: anna, robot: {" + kBody + ", " + kWheels + "}}\n"));
  EXPECT_NE(
      error.find(
          "robot `anna` is simulated and has no start pose: expected `pose`, `poses` or `scatter`"),
      std::string::npos)
      << error;
}

TEST(BuildErrors, ScatterThatIsTooFullSaysSo) {
  Host host;
  const std::string error = host.error_of(
      scenario_text("  - {name: anna, scatter: {count: 12, x_m: [0, 1], y_m: [0, 0.2]}, robot: {" +
                    kBody + ", " + kWheels + "}}\n"));
  EXPECT_NE(error.find("after 10000 tries: `scatter` asks for too many robots, or for more "
                       "clearance than x_m 0 to 1 and y_m 0 to 0.2 leave"),
            std::string::npos)
      << error;
}

TEST(Build, ScatteredRobotsKeepTheirClearanceAndFollowTheSeed) {
  Host host;
  const auto places = [&host](int seed) {
    const auto built = host.build_text(scenario_text(
        "  - {name: anna, scatter: {count: 30, x_m: [0, 5], y_m: [0, 5], clearance_m: 0.2}, robot: "
        "{" +
            kBody + ", " + kWheels + "}}\n",
        "seed: " + std::to_string(seed) + "\n"));
    EXPECT_TRUE(built.has_value());
    std::vector<Vec2> all;
    for (const sim::RobotSpec& robot : built->spec.robots) all.push_back(robot.X_WR.position());
    return all;
  };
  const std::vector<Vec2> first = places(1);
  ASSERT_EQ(first.size(), 30U);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE(squared_norm(first[i] - first[k]), 0.25 - 1e-12);
    }
  }
  EXPECT_EQ(places(1), first);
  EXPECT_NE(places(2), first);
}

TEST(BuildErrors, AChecksSensorThatGivesSomethingElseIsRefused) {
  Host host;
  const std::string robot = one("sensors: [{name: eye, driver: virtual_laser}], " + kWheels);
  const auto with = [&](const std::string& checks) {
    return host.error_of("checks: " + checks + "\n" + robot);
  };
  EXPECT_EQ(with("{touches: [{robots: [anna], sensor: eye}]}"),
            "s.yaml:1:45: `touches`: sensor `eye` of robot `anna` gives ranges; expected one that "
            "gives contact");
  EXPECT_EQ(with("{sightings: {real: eye, twin: eye}}"),
            "s.yaml:1:28: `sightings`: expected a robot with both sensors whose `eye` is a real "
            "camera that gives sightings");
}

/// A virtual camera would confirm itself.
TEST(BuildErrors, SightingsNeedARealCameraAndAVirtualOne) {
  Host host;
  const std::string robot =
      "name: a\nduration_s: 1\nrobots: [{name: real-1, file: ../robots/recorded-create.yaml}]\n";
  EXPECT_EQ(host.error_of(robot + "checks: {sightings: {real: camera, twin: camera_twin}}\n"),
            "none");
  const std::string itself =
      host.error_of(robot + "checks: {sightings: {real: camera_twin, twin: camera_twin}}\n");
  EXPECT_NE(itself.find("whose `camera_twin` is a real camera"), std::string::npos) << itself;
  const std::string real =
      host.error_of(robot + "checks: {sightings: {real: camera, twin: camera}}\n");
  EXPECT_NE(real.find("whose `camera` is a virtual camera"), std::string::npos) << real;
}

}  // namespace
}  // namespace rave::runtime::testing
