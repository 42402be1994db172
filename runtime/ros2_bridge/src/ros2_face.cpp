// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2_bridge/ros2_face.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include "rave/bus/sequence.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/ros2/names.hpp"

namespace rave::runtime {
namespace {

bus::Multicast multicast_of(config::Ros2Multicast multicast) {
  switch (multicast) {
    case config::Ros2Multicast::kDiscovery:
      return bus::Multicast::kDiscovery;
    case config::Ros2Multicast::kData:
      return bus::Multicast::kData;
    case config::Ros2Multicast::kNone:
      break;
  }
  return bus::Multicast::kNone;
}

ros2::NodeForm form_of(config::Ros2Nodes nodes) {
  switch (nodes) {
    case config::Ros2Nodes::kHumble:
      return ros2::NodeForm::kHumble;
    case config::Ros2Nodes::kIron:
      return ros2::NodeForm::kIron;
    case config::Ros2Nodes::kNone:
      break;
  }
  return ros2::NodeForm::kNone;
}

ros2::Network network_of(const config::ScenarioFile& scenario, const std::string& host) {
  const config::Ros2File& file = scenario.ros2;
  const std::string run = scenario.name.value.substr(0, 50);
  ros2::Network network;
  network.name = "rave/" + run + (host.empty() ? "" : "/" + host.substr(0, 50));
  network.domain = static_cast<std::uint32_t>(file.domain);
  network.interface = file.interface;
  network.peers = file.peers;
  network.multicast = multicast_of(file.multicast);
  network.nodes = form_of(file.nodes);
  network.node = ros2::word_of(network.name);
  return network;
}

std::optional<GeoFrame> earth_of(const std::optional<config::GeoOriginFile>& file) {
  if (!file) return std::nullopt;
  return GeoFrame({file->latitude_deg, file->longitude_deg, file->altitude_m},
                  deg_to_rad(file->yaw_deg));
}

/// The texts and transforms of one message.
class Transforms {
 public:
  /// The texts must outlive this object.
  void add(std::string& parent, std::string& child, const Pose2& X_PC, double z_m, SimTime stamp) {
    ros2::TransformStamped& made = all_.emplace_back();
    made.header.stamp = ros2::time_of(stamp.ns);
    made.header.frame_id = parent.data();
    made.child_frame_id = child.data();
    made.transform.translation = {X_PC.x, X_PC.y, z_m};
    made.transform.rotation = ros2::quaternion_of(X_PC.yaw);
  }
  [[nodiscard]] ros2::TfMessage message() {
    ros2::TfMessage made{};
    bus::borrow(made.transforms, all_);
    return made;
  }

 private:
  std::vector<ros2::TransformStamped> all_;
};

}  // namespace

Result<std::unique_ptr<Ros2Face>> Ros2Face::open(const config::ExpandedScenario& scenario,
                                                 const sim::Engine& engine,
                                                 const std::string& host) {
  std::vector<RobotId> shown;
  const auto& robots = engine.spec().robots;
  for (std::uint32_t r = 0; r < robots.size(); ++r) {
    if (scenario.groups[robots[r].type].robot.ros2) shown.emplace_back(r);
  }
  const auto here = [&](RobotId robot) { return engine.is_local(robot); };
  // Without a robot to show there is no participant, which would cost threads and ports.
  if (std::ranges::none_of(shown, here)) return nullptr;
  RAVE_TRY_ASSIGN(auto participant, ros2::Participant::open(network_of(scenario.scenario, host)));
  std::unique_ptr<Ros2Face> face(new Ros2Face(std::move(participant)));
  face->period_ns_ = from_seconds(scenario.scenario.ros2.period_s).ns;
  face->earth_ = earth_of(scenario.scenario.geo_origin);
  for (const RobotId robot : shown) {
    if (here(robot)) RAVE_TRY(face->add(engine, robot));
  }
  // The host of the first shown robot gives the time; a clock must have one writer.
  RAVE_TRY(face->begin(engine, here(shown.front())));
  return face;
}

Status Ros2Face::begin(const sim::Engine& engine, bool keeps_time) {
  if (keeps_time) {
    RAVE_TRY_ASSIGN(auto clock, ros2::Writer<ros2::Clock>::create(*participant_, "/clock"));
    clock_.emplace(std::move(clock));
  }
  RAVE_TRY_ASSIGN(auto tf, ros2::Writer<ros2::TfMessage>::create(*participant_, "/tf"));
  RAVE_TRY_ASSIGN(auto fixed, ros2::Writer<ros2::TfMessage>::create(*participant_, "/tf_static",
                                                                    ros2::kWriteKept));
  tf_.emplace(std::move(tf));
  tf_static_.emplace(std::move(fixed));
  write_static(engine);
  participant_->announce();
  return {};
}

Status Ros2Face::add(const sim::Engine& engine, RobotId id) {
  const sim::RobotSpec& spec = engine.spec().robots[id.value()];
  const std::string name = ros2::word_of(spec.name);
  const std::string prefix = name + "/";
  Robot robot{id,
              prefix,
              prefix + "odom",
              prefix + "base_link",
              {},
              std::nullopt,
              Ros2Reading(prefix + "odom", prefix + "base_link"),
              std::nullopt,
              std::nullopt};
  RAVE_TRY(add_sensors(engine, robot));
  if (!robot.odometry) {
    RAVE_TRY_ASSIGN(auto writer,
                    ros2::Writer<ros2::Odometry>::create(*participant_, "/" + name + "/odom"));
    robot.own_writer.emplace(std::move(writer));
  }
  RAVE_TRY_ASSIGN(auto description,
                  ros2::Writer<ros2::String>::create(
                      *participant_, "/" + name + "/robot_description", ros2::kWriteKept));
  std::string urdf =
      urdf_of(engine.spec().world.robots[id.value()], engine.spec().types[spec.type], name, prefix);
  (void)description.write({urdf.data()});
  robot.description.emplace(std::move(description));
  robots_.push_back(std::move(robot));
  return {};
}

Status Ros2Face::add_sensors(const sim::Engine& engine, Robot& robot) {
  const sim::RobotSpec& spec = engine.spec().robots[robot.id.value()];
  const sim::RobotType& type = engine.spec().types[spec.type];
  const auto kind_of = [&](std::uint32_t index) {
    const Ros2Kind kind =
        ros2_kind(*engine.sensor(robot.id, index).info, type.sensors[index].driver);
    // Without the place of the world on Earth a pose has no latitude and longitude.
    return kind == Ros2Kind::kFix && !earth_ ? Ros2Kind::kNone : kind;
  };
  std::map<Ros2Kind, int> count;
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) ++count[kind_of(s)];
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    const Ros2Kind kind = kind_of(s);
    const std::string sensor = ros2::word_of(type.sensors[s].name);
    if (kind == Ros2Kind::kNone) continue;
    const bool first_odometry = kind == Ros2Kind::kOdometry && !robot.odometry;
    if (first_odometry) robot.odometry = s;
    // The usual topic name; if several sensors share it, the sensor's name is appended.
    std::string topic = fmt::format("/{}{}", robot.prefix, ros2_topic(kind));
    if (count[kind] > 1 && !first_odometry) topic += "/" + sensor;
    RAVE_TRY_ASSIGN(auto writer, writer_for(kind, topic));
    std::string frame = robot.prefix + sensor;
    if (kind == Ros2Kind::kOdometry) frame = robot.odom_frame;
    if (kind == Ros2Kind::kFix) frame = robot.base_frame;  // A pose describes the body.
    const Pose2 X_WM = type.pose_from == s ? type.X_WM.value_or(Pose2{}) : Pose2{};
    robot.sensors.push_back(
        {s, 0, Ros2Reading(std::move(frame), robot.base_frame), std::move(writer), X_WM});
  }
  return {};
}

Result<Ros2Face::AnyWriter> Ros2Face::writer_for(Ros2Kind kind, const std::string& topic) const {
  const auto make = [&]<class Message>(Message /*kind*/) -> Result<AnyWriter> {
    RAVE_TRY_ASSIGN(auto writer, ros2::Writer<Message>::create(*participant_, topic));
    return AnyWriter(std::move(writer));
  };
  switch (kind) {
    case Ros2Kind::kScan:
      return make(ros2::LaserScan{});
    case Ros2Kind::kRange:
      return make(ros2::Range{});
    case Ros2Kind::kOdometry:
      return make(ros2::Odometry{});
    case Ros2Kind::kImu:
      return make(ros2::Imu{});
    case Ros2Kind::kBattery:
      return make(ros2::BatteryState{});
    case Ros2Kind::kFix:
      return make(ros2::NavSatFix{});
    case Ros2Kind::kNone:
      break;
  }
  return fail(ErrorCode::kInvalidArgument, "not a message of ROS 2");
}

void Ros2Face::write_static(const sim::Engine& engine) {
  Transforms all;
  std::deque<std::string> names;  // A deque, so that its elements keep their addresses.
  for (Robot& robot : robots_) {
    const sim::EngineSpec& spec = engine.spec();
    for (const sim::SensorSpec& sensor : spec.types[spec.robots[robot.id.value()].type].sensors) {
      names.push_back(robot.prefix + ros2::word_of(sensor.name));
      all.add(robot.base_frame, names.back(), sensor.X_RS, sensor.z_m, {});
    }
  }
  (void)tf_static_->write(all.message());
}

// A failed write does not end the run: the next message follows.
void Ros2Face::after_step(const StepView& step) {
  const sim::Engine& engine = step.engine;
  // In each step, so that nodes with `use_sim_time` see time pass evenly.
  if (clock_) {
    ros2::Clock now{};
    now.clock = ros2::time_of(engine.time().ns);
    (void)clock_->write(now);
  }
  for (Robot& robot : robots_) write_new(engine, robot);
  // Sensors are written when they have a new sample; transforms and poses at a rate, since /tf of
  // many robots is large.
  if (engine.time().ns < due_ns_) return;
  due_ns_ = engine.time().ns + period_ns_;
  write_transforms(engine);
}

void Ros2Face::write_new(const sim::Engine& engine, Robot& robot) {
  for (Sensor& sensor : robot.sensors) {
    const sim::SensorSample sample = engine.sensor(robot.id, sensor.index);
    if (sample.header->sequence == sensor.written) continue;
    // A receiver reports that it has no fix; other sensors without readings publish nothing.
    const bool fix = std::holds_alternative<ros2::Writer<ros2::NavSatFix>>(sensor.writer);
    if (sample.header->count == 0 && !fix) continue;
    sensor.written = sample.header->sequence;
    write_sensor(sensor, sample);
  }
}

void Ros2Face::write_sensor(Sensor& sensor, const sim::SensorSample& sample) const {
  Ros2Reading& reading = sensor.reading;
  const SimTime stamp{sample.header->stamp_ns};
  if (auto* const scan = std::get_if<ros2::Writer<ros2::LaserScan>>(&sensor.writer)) {
    (void)scan->write(reading.scan(sample));
  } else if (auto* const range = std::get_if<ros2::Writer<ros2::Range>>(&sensor.writer)) {
    (void)range->write(reading.range(sample));
  } else if (auto* const odometry = std::get_if<ros2::Writer<ros2::Odometry>>(&sensor.writer)) {
    const auto* const newest =
        static_cast<const OdometryReading*>(sample.records) + (sample.header->count - 1);
    (void)odometry->write(reading.odometry(*newest, stamp));
  } else if (auto* const imu = std::get_if<ros2::Writer<ros2::Imu>>(&sensor.writer)) {
    (void)imu->write(reading.imu(sample));
  } else if (auto* const battery = std::get_if<ros2::Writer<ros2::BatteryState>>(&sensor.writer)) {
    (void)battery->write(reading.battery(sample));
  } else if (auto* const fix = std::get_if<ros2::Writer<ros2::NavSatFix>>(&sensor.writer)) {
    (void)fix->write(reading.fix(sample, *earth_, sensor.X_WM));
  }
}

void Ros2Face::write_transforms(const sim::Engine& engine) {
  Transforms all;
  for (Robot& robot : robots_) {
    const sim::ReportedPose& reported = engine.reported(robot.id);
    if (!reported.known) continue;
    const Pose2 X_WB{reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
    Pose2 X_OB = X_WB;
    if (robot.odometry) {
      const sim::SensorSample sample = engine.sensor(robot.id, *robot.odometry);
      if (sample.header->count == 0) continue;
      const auto* const newest =
          static_cast<const OdometryReading*>(sample.records) + (sample.header->count - 1);
      X_OB = {newest->x_m, newest->y_m, newest->yaw_rad};
    } else {
      const OdometryReading own{X_WB.x,
                                X_WB.y,
                                X_WB.yaw,
                                reported.velocity.vx,
                                reported.velocity.wz,
                                reported.pose.variance_xy_m2,
                                reported.pose.variance_yaw_rad2};
      (void)robot.own_writer->write(robot.own.odometry(own, reported.stamp));
    }
    // The chain of frames must end at the reported pose of the robot.
    // map -> odom is what corrects the odometry: X_WB = X_WO * X_OB (REP-105).
    const Pose2 X_WO = robot.odometry ? compose(X_WB, inverse(X_OB)) : Pose2{};
    all.add(map_frame_, robot.odom_frame, X_WO, 0, engine.time());
    all.add(robot.odom_frame, robot.base_frame, X_OB, 0, engine.time());
  }
  (void)tf_->write(all.message());
}

}  // namespace rave::runtime
