// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "../src/stepped_endpoint.hpp"
#include "fake_endpoint.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::manager {

/// A host of one robot, which answers as soon as it is heard.
class EngineHost {
 public:
  EngineHost(sim::EngineSpec spec, std::uint32_t number) : writer(10 + number) {
    spec.local = {RobotId(number)};
    engine_ = sim::testing::make_engine(std::move(spec));
    report_.host = number;
    EXPECT_TRUE(engine_->propose(report_));
  }
  /// Of a world that it has had it takes only who sent it.
  void take(const sim::WorldStep& world, const sim::AuthorityState& state) {
    epoch_ = 5;
    if (world.step < report_.step) return;
    done = world.last;
    if (done) return;
    ASSERT_TRUE(engine_->join(world, state));
    ASSERT_TRUE(engine_->propose(report_));
  }
  void speak(const SteppedEndpoint::Visit& visit) {
    if (gone || (says && !says(report_.step))) return;
    spoken = spoken_in_ == report_.step ? spoken + 1 : 1;
    spoken_in_ = report_.step;
    if (forwards) report_.inputs = forwards(report_.step);
    const std::uint64_t hash = engine_->hash().value();
    bus::HostReport& message = message_.fill(report_, epoch_, hash);
    message.writer = writer;
    visit(message);
    if (!twice) return;
    message.hash = hash + 1;
    visit(message);
  }
  /// Says from now on that it knows of none.
  void lose_manager() { epoch_ = 0; }
  [[nodiscard]] const sim::HostReport& report() const { return report_; }

  std::uint64_t writer;
  std::function<bool(std::uint64_t)> says{};  ///< Whether it says its report of this step now.
  /// What people have asked of it by now; may be empty.
  std::function<std::vector<sim::WorldInput>(std::uint64_t)> forwards{};
  int spoken = 0;      ///< How often it said its report of this step.
  bool twice = false;  ///< Says all that it says again, with something else.
  bool gone = false;
  bool done = false;  ///< It has had the last world.

 private:
  std::unique_ptr<sim::Engine> engine_;
  sim::HostReport report_;
  lock_step::ReportMessage message_;
  std::uint64_t epoch_ = 0;
  std::uint64_t spoken_in_ = 0;
};

/// Carries messages between a manager in lock-step and its hosts, in the thread of the manager.
class FakeSteppedEndpoint final : public SteppedEndpoint {
 public:
  explicit FakeSteppedEndpoint(std::vector<EngineHost>& hosts) : hosts_(hosts) {
    for (const EngineHost& host : hosts) {
      common.hosts[host.writer] = host.report().host;
    }
  }
  void wait(Duration /*timeout*/, const std::stop_token& /*stop*/) override {
    if (meanwhile) meanwhile();
    // Hosts go when they hear of the end.
    for (EngineHost& host : hosts_) {
      if (common.over() || host.done) leave(host);
    }
  }
  void leave(EngineHost& host) {
    if (!std::exchange(host.gone, true)) common.gone.push_back(host.writer);
  }
  ManagerEndpoint& endpoint() noexcept override { return common; }
  void take_reports(const Visit& visit) override {
    for (EngineHost& host : hosts_) host.speak(visit);
  }
  bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                       bool has_one) override {
    if (has_one || !handed) return false;
    world = handed->first;
    authority = handed->second;
    return true;
  }
  void refuse(const bus::HostReport& /*report*/, std::string_view why) override {
    refused.emplace_back(why);
  }
  Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
              const std::vector<HostSlot>& slots) override {
    last_ = {world, authority};
    for (const sim::InputAnswer& answer : world.answers) answers.emplace_back(world.step, answer);
    deliver(slots);
    return {};
  }
  void resend(const std::vector<HostSlot>& slots) override {
    ++resent;
    deliver(slots);
  }

  FakeEndpoint common;
  std::function<void()> meanwhile{};
  /// Whether this host does not get the world of this step.
  std::function<bool(const EngineHost&, std::uint64_t)> loses{};
  std::optional<std::pair<sim::WorldStep, sim::AuthorityState>> handed{};
  std::vector<std::string> refused;
  std::vector<std::pair<std::uint64_t, sim::InputAnswer>> answers;  ///< By step.
  int resent = 0;

 private:
  void deliver(const std::vector<HostSlot>& slots) {
    for (EngineHost& host : hosts_) {
      if (host.gone || slots[host.report().host].writer != host.writer) continue;
      if (!loses || !loses(host, last_.first.step)) host.take(last_.first, last_.second);
    }
  }

  std::vector<EngineHost>& hosts_;
  std::pair<sim::WorldStep, sim::AuthorityState> last_;
};

}  // namespace rave::manager
