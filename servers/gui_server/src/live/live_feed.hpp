// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "live/live_box.hpp"
#include "rave/maps/local_maps.hpp"
#include "rave/maps/team_maps.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/probe/probes.hpp"

namespace rave::gui_server {

/// Hands copies of a run to the server's thread: pictures as often as pages ask for them, at most
/// 60 times a second, and four times without pages; events always. The thread of the run, which
/// never waits here.
class LiveFeed final : public runtime::RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  /// Called before the first step.
  using Begun = std::function<Status(const runtime::RunView& run)>;

  /// `catalogue`: of the run, for probes; outlives it.
  LiveFeed(std::shared_ptr<LiveBox> box, plugin::Catalogue& catalogue, Begun begun)
      : box_(std::move(box)), catalogue_(catalogue), begun_(std::move(begun)) {}

  Status run_begins(const runtime::RunView& run) override;
  void after_step(const runtime::StepView& step) override;
  void held(const sim::Engine& engine) override;

 private:
  void take_news(const runtime::StepView& step);
  void draw(const sim::Engine& engine, int slower);
  void draw_maps(const sim::Engine& engine, int slower);
  void draw_poses(const sim::Engine& engine, PosesAt& poses) const;
  static void draw_truth(const sim::Engine& engine, bool wanted, PosesAt& poses);
  static void draw_readings(const sim::Engine& engine, const Audience& wants, LivePicture& picture);
  void draw_probes(const sim::Engine& engine, LivePicture& picture);

  std::shared_ptr<LiveBox> box_;
  plugin::Catalogue& catalogue_;
  Begun begun_;
  const runtime::BodyKinds* kinds_ = nullptr;
  std::vector<double> touching_until_s_;  ///< By robot.
  Clock::time_point drawn_{};
  maps::LocalMaps maps_;
  /// The Map Server of a run in one process.
  std::optional<maps::TeamMaps> global_maps_;
  std::vector<std::uint32_t> mapping_;  ///< Memory of draw_maps().
  probe::Probes probes_;
  std::uint32_t serial_ = 0;
};

}  // namespace rave::gui_server
