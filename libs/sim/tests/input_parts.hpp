// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../src/hand_overs.hpp"
#include "../src/order_book.hpp"
#include "../src/radio.hpp"
#include "../src/run_inputs.hpp"
#include "../src/spec_checks.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {

/// Of the robot that most of these tests are about.
inline constexpr RobotId kRobot(0);

/// What inputs act on, without an engine around it.
struct InputParts : private HandOvers::Site {
  explicit InputParts(EngineSpec of)
      : spec(std::move(of)),
        pool(1),
        roster(local_robots(spec)),
        truth(spec, pool),
        radio(spec, roster.local, roster.logs, pool),
        reported(spec.robots.size()),
        guards(spec.robots.size()) {
    roster.lay_out(spec, nullptr);
    EXPECT_TRUE(radio.make());
    hand_overs.make(&radio);
    for (RobotGroup& group : roster.groups) {
      const Status made = make_group({spec, roster.logs, &radio}, group);
      EXPECT_TRUE(made) << made.error().text();
    }
    truth.begin();
  }
  ~InputParts() override = default;

  /// The events of what was asked since the last call.
  std::vector<Event> told() {
    std::vector<Event> noted;
    log.begin_step(noted);
    return noted;
  }
  OrderMoment moment(std::uint64_t step) {
    return {step, {static_cast<std::int64_t>(step) * spec.step.ns}, reported, hash, events};
  }

  EngineSpec spec;
  ThreadPool pool;
  Roster roster;
  WorldTruth truth;
  Radio radio;
  std::vector<ReportedPose> reported;
  std::vector<RobotGuard> guards;
  RunHash hash;
  std::vector<Event> events;
  std::vector<std::string> calls;  ///< Of the site and of those who are told.
  InputLog log{hash};
  OrderBook orders{spec, roster, log};
  HandOvers hand_overs{{spec, roster, truth, guards, reported, log, *this}};
  RunInputs inputs{{spec, roster, truth, guards, orders, hand_overs, log,
                    [this](RobotId) { calls.emplace_back("body"); },
                    [this](const ObstacleChange&) { calls.emplace_back("obstacle"); }}};

 private:
  void halt(RobotGroup&) noexcept override { calls.emplace_back("halt"); }
  void drivers_changed(RobotId, const Arrival&) override { calls.emplace_back("changed"); }
  void drivers_restored(RobotId) override { calls.emplace_back("restored"); }
  [[nodiscard]] Status start_guards(RobotGroup&) override {
    calls.emplace_back("guards");
    return {};
  }
  void before_closing(const RobotGroup&) const override {}
  [[nodiscard]] bool close_all(std::vector<ToClose> drivers) override { return drivers.empty(); }
};

}  // namespace rave::sim::testing
