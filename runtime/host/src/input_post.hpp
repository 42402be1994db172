// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/control/run_control.hpp"
#include "rave/host/input_forwarder.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::runtime {

/// What people ask of the robots of a host in lock-step, between its order desk and the authority
/// that numbers it: each input goes with every report until a world answers it, and counts from the
/// step of that world on. Belongs to the thread of the run.
class InputPost final : public InputForwarder {
 public:
  using Clock = std::chrono::steady_clock;
  /// Inputs that wait at the same time; stops are never too many.
  static constexpr std::size_t kMostWaiting = 4096;
  /// And their points, with those of long paths.
  static constexpr std::size_t kMostPoints = 100'000;

  /// None is owned; `log` may be null. `first`: above all numbers of an earlier process of this
  /// host.
  InputPost(const sim::Engine& engine, std::uint32_t host, std::uint64_t first, LogSink* log)
      : engine_(engine), host_(host), number_(first), log_(log) {}

  // InputForwarder.
  Result<std::string> give(const request::Request& request) override;
  [[nodiscard]] std::optional<std::uint64_t> take_given() override {
    return std::exchange(given_, std::nullopt);
  }
  [[nodiscard]] bool is_driven(const std::string& robot) const override;
  void await(std::uint64_t given, RunControl::Asked asked, std::string text) override;

  /// Adds to a report what it does not have yet.
  void put(sim::HostReport& report) const;
  /// A world has come: what it answers waits no longer.
  void take(const sim::WorldStep& world);
  /// Its step is done, but for what this host `refused`. Returns whether a request was answered.
  bool settle(const std::vector<sim::InputRefusal>& refused);
  /// The run stands, and `why`: requests that have waited for a while get an interim answer.
  /// Returns whether one was. `step` comes next.
  bool put_off(std::string_view why, std::uint64_t step, Clock::time_point now);
  /// Nothing of what waits is done, and `why`.
  void drop(std::string_view why);

 private:
  struct Waiting {
    sim::WorldInput input;
    std::uint64_t given = 0;
    bool answered = false;
  };
  /// A request, which may be several inputs.
  struct Given {
    std::size_t open = 0;
    std::optional<RunControl::Asked> asked{};
    std::string text{};
    std::string refused{};
    bool told = false;  ///< Who asked has an answer that leaves the outcome open.
  };
  /// An input that a world has numbered.
  struct Made {
    std::uint64_t sequence = 0;
    std::uint64_t given = 0;
  };
  [[nodiscard]] Result<std::vector<RobotId>> meant(const request::Request& request) const;
  [[nodiscard]] bool will_be_stopped(RobotId robot) const;
  [[nodiscard]] bool is_held_anew(RobotId robot) const;
  [[nodiscard]] Status check_room(const std::vector<sim::WorldInput>& inputs) const;
  Result<std::string> give_hold(const request::Request& request);
  Result<std::string> give_order(const request::Request& request);
  std::string queue(std::vector<sim::WorldInput> inputs, std::string text);
  void end(std::uint64_t given, std::string_view refused);
  [[nodiscard]] std::string name_of(RobotId robot) const;
  [[nodiscard]] std::string names_of(const std::vector<RobotId>& robots) const;

  const sim::Engine& engine_;
  std::uint32_t host_;
  std::uint64_t number_;  ///< Of the last input.
  LogSink* log_;
  std::vector<Waiting> waiting_;  ///< In the order of their numbers.
  std::map<std::uint64_t, Given> requests_;
  std::uint64_t requested_ = 0;
  std::optional<std::uint64_t> given_;
  std::vector<Made> made_;
  std::uint64_t step_ = 0;  ///< Of the last world.
  bool answered_ = false;
};

}  // namespace rave::runtime
