// SPDX-License-Identifier: Apache-2.0
// A host and its environment manager in two processes: what the host believes of one that it has
// missed.
#include "rave/protocol/host_port.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::lock_step {
namespace {

using bus::testing::eventually;
using bus::testing::PeerProcess;
using bus::testing::TestDomain;

constexpr std::uint64_t kEpoch = 7;
constexpr std::uint64_t kNextEpoch = 8;

/// What the host says.
class Lines final : public LogSink {
 public:
  void write(LogLevel, std::string_view, std::string_view message) override {
    const std::scoped_lock lock(mutex_);
    said_ += std::string(message) + '\n';
  }
  [[nodiscard]] bool has(std::string_view words) const {
    const std::scoped_lock lock(mutex_);
    return said_.find(words) != std::string::npos;
  }
  void clear() {
    const std::scoped_lock lock(mutex_);
    said_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::string said_;
};

/// Sends a world in the name of another process, as if it had been long on its way.
class Ghost {
 public:
  explicit Ghost(const TestDomain& domain) {
    bus::BusConfig config = domain.config("ghost");
    config.beside = true;
    config.local_transport = false;
    bus_ = *bus::Bus::open(config);
    worlds_.emplace(*bus::Writer<bus::WorldStep>::create(*bus_));
  }
  /// The process of the host, once it is there and listens to this one.
  [[nodiscard]] std::uint64_t await_host() {
    std::uint64_t host = 0;
    EXPECT_TRUE(eventually([&] {
      static_cast<void>(bus_->take_events());
      for (const bus::BusProcess& process : bus_->processes()) {
        if (process.name == "host") host = process.writer;
      }
      return host != 0 && worlds_->readers() == 1;
    }));
    return host;
  }
  /// The last world of step 1; when this returns the host has got it.
  void throw_world(std::uint64_t manager, std::uint64_t host) {
    sim::WorldStep world;
    world.begin(1, 0);
    world.last = true;
    WorldMessage message;
    auto filled = message.fill(world, {}, kEpoch);
    ASSERT_TRUE(filled);
    message.address(std::array{host});
    bus::WorldStep& sample = **filled;
    std::ranges::copy(bus_->config().run.bytes, sample.run);
    sample.writer = manager;
    ASSERT_EQ(dds_write(worlds_->handle(), &sample), DDS_RETCODE_OK);
    EXPECT_EQ(dds_wait_for_acks(worlds_->handle(), DDS_SECS(bus::testing::kPatience_s)),
              DDS_RETCODE_OK);
  }

 private:
  std::unique_ptr<bus::Bus> bus_;
  std::optional<bus::Writer<bus::WorldStep>> worlds_;
};

class HostPortTest : public ::testing::Test {
 protected:
  /// The host has had the world of step 0 from its manager.
  void begin() {
    manager_ = start(kEpoch);
    manager_id_ = std::stoull("0" + manager_->line());
    ASSERT_NE(manager_id_, 0U);
    Identity identity;
    identity.name = "only";
    auto port = HostPort::open(domain_.config("host"), identity, &log_);
    ASSERT_TRUE(port) << port.error().text();
    port_ = *std::move(port);
    ghost_ = std::make_unique<Ghost>(domain_);
    host_id_ = ghost_->await_host();
    report_.begin(0);
    const auto patience = deadline();
    const auto answer = port_->exchange(report_, 0, world_, [&] { return over(patience); });
    ASSERT_TRUE(answer) << answer.error().text();
    ASSERT_EQ(*answer, HostPort::Answer::kWorld);
    log_.clear();
  }
  /// The host has done step 0, and misses its manager. Then a late world of that one comes, and
  /// when the host has had time to believe it, `then` is done. What the host has in the end is what
  /// the manager of that time has said.
  void miss(const std::function<void()>& then) {
    report_.begin(1);
    int looks = 0;
    const auto patience = deadline();
    const auto answer = port_->exchange(report_, 0, world_, [&] {
      if (log_.has("the environment manager is lost")) {
        // Between one and the next the host takes in what it has got.
        ++looks;
        if (looks == 1) ghost_->throw_world(manager_id_, host_id_);
        if (looks == 2) then();
      }
      return over(patience);
    });
    ASSERT_TRUE(answer) << answer.error().text();
    EXPECT_EQ(*answer, HostPort::Answer::kWorld);
    EXPECT_GE(looks, 2);
    EXPECT_EQ(world_.step, 1U);
    EXPECT_FALSE(world_.last) << "it believes a manager that it has missed";
  }
  /// It is missed after three seconds of silence, and not by accident on a busy machine.
  [[nodiscard]] std::unique_ptr<PeerProcess> start(std::uint64_t epoch) const {
    return std::make_unique<PeerProcess>(
        domain_, "answer", "manager",
        std::vector<std::string>{"lease_s=3", "epoch=" + std::to_string(epoch)}, "peer_lock_step");
  }

  std::unique_ptr<PeerProcess> manager_;
  std::unique_ptr<HostPort> port_;

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] static Clock::time_point deadline() {
    return Clock::now() + std::chrono::seconds(bus::testing::kPatience_s);
  }
  [[nodiscard]] static bool over(Clock::time_point when) { return Clock::now() > when; }

  TestDomain domain_;
  Lines log_;
  std::unique_ptr<Ghost> ghost_;
  std::uint64_t manager_id_ = 0;
  std::uint64_t host_id_ = 0;
  sim::HostReport report_;
  sim::WorldStep world_;
};

TEST_F(HostPortTest, ALateWorldOfADeadManagerDoesNotBringItBack) {
  ASSERT_NO_FATAL_FAILURE(begin());
  manager_->kill();
  std::unique_ptr<PeerProcess> next;
  miss([&] {
    next = start(kNextEpoch);
    EXPECT_NE(next->line(), "");
  });
  EXPECT_TRUE(port_->changed_hands());
}

TEST_F(HostPortTest, AManagerThatWasMissedAndComesBackGoesOn) {
  ASSERT_NO_FATAL_FAILURE(begin());
  manager_->pause();
  miss([&] { manager_->resume(); });
  EXPECT_FALSE(port_->changed_hands());
}

}  // namespace
}  // namespace rave::lock_step
