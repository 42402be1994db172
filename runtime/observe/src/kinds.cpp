// SPDX-License-Identifier: Apache-2.0
#include "rave/observe/kinds.hpp"

namespace rave::runtime {

BodyKinds::BodyKinds(const sim::EngineSpec& spec, const std::vector<std::string>& robot_words)
    : first_robot_(static_cast<std::uint32_t>(spec.world.obstacles.size())) {
  for (const world::Obstacle& obstacle : spec.world.obstacles) {
    add(obstacle.body);
  }
  std::size_t real_robots = 0;
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    const bool simulated = spec.types[spec.robots[r].type].simulated;
    words_.emplace_back();
    kinds_.emplace_back();
    hunters_.push_back(robot_words[r] == "hunter" ? 1 : 0);
    set_reality(RobotId(static_cast<std::uint32_t>(r)), simulated);
    std::string colour = spec.world.robots[r].colour;
    if (colour.empty() && !simulated) colour = report::robot_colour(real_robots);
    if (!simulated) ++real_robots;
    colours_.push_back(std::move(colour));
    names_.push_back(spec.robots[r].name);
  }
  first_added_ = count();
}

void BodyKinds::set_reality(RobotId robot, bool simulated) {
  ++revision_;
  const std::uint32_t body = body_of(robot);
  words_[body] = simulated ? "simulated" : "real";
  kinds_[body] = hunters_[robot.value()] != 0
                     ? report::Kind::kHunter
                     : (simulated ? report::Kind::kSimulatedRobot : report::Kind::kRecordedRobot);
}

void BodyKinds::follow(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kHandedOver) continue;
    set_reality(event.robot, spec.types[spec.robots[event.robot.value()].type].simulated);
  }
}

void BodyKinds::add(const world::Body& obstacle) {
  ++revision_;
  const bool real = obstacle.layer == Layer::kMappedReal;
  const bool landmark = real && obstacle.code.has_value();
  words_.emplace_back(landmark ? "landmark" : (real ? "mapped_wall" : "virtual_obstacle"));
  kinds_.push_back(landmark ? report::Kind::kLandmark
                            : (real ? report::Kind::kMappedWall : report::Kind::kVirtualObstacle));
  colours_.push_back(obstacle.colour);
  names_.push_back(obstacle.name);
}

void BodyKinds::learn(const world::WorldModel& world) {
  while (count() < world.body_count()) add(world.body(count()));
}

}  // namespace rave::runtime
