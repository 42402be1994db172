// SPDX-License-Identifier: Apache-2.0
// Ten robots that move as one by what they tell each other.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "rave/math/transform.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

/// What a flock does, averaged over the second half of a run.
struct Behaviour {
  double order = 0;        ///< Length of the mean of all headings that move: 1 is one direction.
  double spacing_m = 0;    ///< Mean distance to the nearest neighbour, of centres.
  double spread_m = 0;     ///< Mean distance to the middle of all.
  double nearest_m = 1e9;  ///< Smallest distance of centres ever.
  std::size_t contacts = 0;
  std::uint64_t hash = 0;
  std::vector<Pose2> end;
  sim::RadioCounts radio;
};

class Flock : public ScenarioTest {
 protected:
  /// The scenario with one of its robots changed.
  config::ExpandedScenario scenario(const std::string& from = {}, const std::string& to = {}) {
    const auto path = std::filesystem::path(RAVE_SOURCE_DIR) / "scenarios/flock/scenario.yaml";
    std::ifstream file(path);
    std::stringstream content;
    content << file.rdbuf();
    std::string text = content.str();
    if (!from.empty()) {
      const auto at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      if (at != std::string::npos) text.replace(at, from.size(), to);
    }
    const auto expanded = config::expand_scenario_text(text, path);
    EXPECT_TRUE(expanded) << (expanded ? "" : expanded.error().text());
    return expanded.value_or(config::ExpandedScenario{});
  }

  Behaviour behaviour_of(const config::ExpandedScenario& scenario, double end_s) {
    Behaviour found;
    const auto world = make_world(scenario);
    if (!world.engine) return found;
    sim::Engine& engine = *world.engine;
    std::size_t samples = 0;
    while (engine.time().seconds() < end_s - 1e-9) {
      const Status status = engine.step();
      if (!status) {
        ADD_FAILURE() << status.error().text();
        return found;
      }
      for (const sim::Event& event : engine.events()) {
        EXPECT_EQ(event.kind, sim::EventKind::kContact) << event.text;
        ++found.contacts;
      }
      const bool second_half = engine.time().seconds() > end_s / 2;
      watch(engine, second_half, found);
      samples += second_half ? 1 : 0;
    }
    found.order /= static_cast<double>(samples);
    found.spacing_m /= static_cast<double>(samples);
    found.spread_m /= static_cast<double>(samples);
    found.hash = engine.hash().value();
    found.radio = engine.radio_counts();
    for (std::uint32_t r = 0; r < 10; ++r) found.end.push_back(engine.snapshot().pose(RobotId(r)));
    return found;
  }

  static void watch(const sim::Engine& engine, bool count, Behaviour& found) {
    Vec2 direction;
    Vec2 middle;
    std::vector<Vec2> places;
    for (std::uint32_t r = 0; r < 10; ++r) {
      const Twist2 v = engine.snapshot().velocity_W(RobotId(r));
      const double speed = std::sqrt(v.vx * v.vx + v.vy * v.vy);
      if (speed > 0.02) direction = direction + (0.1 / speed) * Vec2{v.vx, v.vy};
      places.push_back(engine.snapshot().pose(RobotId(r)).position());
      middle = middle + 0.1 * places.back();
    }
    double spacing = 0;
    double spread = 0;
    for (std::size_t a = 0; a < 10; ++a) {
      double nearest = 1e9;
      for (std::size_t b = 0; b < 10; ++b) {
        if (a != b) nearest = std::min(nearest, std::sqrt(squared_norm(places[a] - places[b])));
      }
      spacing += 0.1 * nearest;
      spread += 0.1 * std::sqrt(squared_norm(places[a] - middle));
      found.nearest_m = std::min(found.nearest_m, nearest);
    }
    if (!count) return;
    found.order += std::sqrt(squared_norm(direction));
    found.spacing_m += spacing;
    found.spread_m += spread;
  }
};

constexpr const char* kTenth = "    kind: tenth\n    variables: {";

TEST_F(Flock, MovesTogetherAndTouchesNothing) {
  const Behaviour flock = behaviour_of(scenario(), 60);
  RecordProperty("order", std::to_string(flock.order));
  RecordProperty("spacing_m", std::to_string(flock.spacing_m));
  EXPECT_EQ(flock.contacts, 0U);
  EXPECT_GT(flock.nearest_m, 2 * 0.13);
  EXPECT_GT(flock.order, 0.75);
  EXPECT_GT(flock.spacing_m, 0.4);
  EXPECT_LT(flock.spacing_m, 1.2);
  EXPECT_LT(flock.spread_m, 1.8);
  EXPECT_GT(flock.radio.delivered, 10'000U);
}

TEST_F(Flock, FallsApartWhenNobodyHearsAnybody) {
  const Behaviour together = behaviour_of(scenario(), 60);
  // The tenth as well, or nine would hear it.
  auto deaf = scenario("    variables: {centre_x_m", "    variables: {range_m: 0.01, centre_x_m");
  deaf.groups[1] = scenario(kTenth, std::string(kTenth) + "range_m: 0.01, ").groups[1];
  const Behaviour alone = behaviour_of(deaf, 60);
  EXPECT_EQ(alone.radio.delivered, 0U);
  EXPECT_LT(alone.order, together.order - 0.2);
  EXPECT_GT(alone.spread_m, together.spread_m + 0.3);
}

TEST_F(Flock, TheTenthIsOneOfThem) {
  const Behaviour with = behaviour_of(scenario(), 30);
  const Behaviour silenced =
      behaviour_of(scenario(kTenth, std::string(kTenth) + "range_m: 0.01, "), 30);
  EXPECT_NE(with.hash, silenced.hash);
  // The others go elsewhere when they do not hear it, and it goes elsewhere when it does not hear
  // them.
  for (std::size_t r = 0; r < 10; ++r) {
    EXPECT_GT(squared_norm(with.end[r].position() - silenced.end[r].position()), 1e-4) << r;
  }
  EXPECT_GT(std::abs(with.spacing_m - silenced.spacing_m), 0.01);
  EXPECT_GT(std::abs(with.spread_m - silenced.spread_m), 0.01);
}

TEST_F(Flock, AnyOfThemMayBeReal) {
  const auto tenth = scenario("  - name: tenth\n    file: ../../robots/flocker.yaml",
                              "  - name: tenth\n    file: ../../robots/recorded-flocker.yaml");
  const auto world = make_world(tenth);
  ASSERT_TRUE(world.engine);
  const std::uint32_t real = robot_named(*world.engine, "tenth");
  std::size_t from_real = 0;
  std::size_t to_real = 0;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(world.engine->step());
    for (const sim::RadioTrace& trace : world.engine->radio()) {
      if (!trace.delivered) continue;
      from_real += trace.from == RobotId(real) ? 1U : 0U;
      to_real += trace.to == RobotId(real) ? 1U : 0U;
      // Nobody hears farther than the radio reaches, by reported poses; both move a little on the
      // way.
      const auto place = [&](RobotId robot) {
        const PoseReading& pose = world.engine->reported(robot).pose;
        return Vec2{pose.x_m, pose.y_m};
      };
      EXPECT_LT(squared_norm(place(trace.from) - place(trace.to)), 3.1 * 3.1);
    }
  }
  EXPECT_GT(from_real, 100U);
  EXPECT_GT(to_real, 100U);
}

TEST_F(Flock, HasOneHashForAnyThreadsAndForProgramsOnTheirOwn) {
  const std::uint64_t one = behaviour_of(scenario(), 8).hash;
  for (const int threads : {2, 3}) {
    auto more = scenario();
    more.scenario.threads = threads;
    EXPECT_EQ(behaviour_of(more, 8).hash, one) << threads << " threads";
  }
  auto isolated = scenario();
  for (config::RobotGroup& group : isolated.groups) group.robot.program->isolate = true;
  EXPECT_EQ(behaviour_of(isolated, 8).hash, one);
}

TEST_F(Flock, ResultAndRecordHaveItsMessages) {
  auto small = scenario();
  small.scenario.duration_s = 3;
  const auto outcome = run(small);
  EXPECT_TRUE(outcome.whole);
  EXPECT_NE(outcome.summary.find("messages"), std::string::npos);
  std::ifstream file(folder_ / "result.json");
  const auto radio = nlohmann::json::parse(file)["radio"];
  EXPECT_EQ(radio["offered"], 300);
  EXPECT_GT(radio["delivered"], 500);
  EXPECT_EQ(radio["lost"]["queue"], 0);
}

}  // namespace
}  // namespace rave::tests
