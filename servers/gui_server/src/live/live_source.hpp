// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "live/component_watch.hpp"
#include "live/live_box.hpp"
#include "live/own_host.hpp"
#include "live/probe_desk.hpp"
#include "live/run_port.hpp"
#include "live/set_values.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/record/run_info.hpp"
#include "rave/sim/engine_spec.hpp"
#include "run/event_fold.hpp"
#include "run/map_book.hpp"

namespace rave::gui_server {

/// A run of this process as its feed shows it. The server's thread, but for end().
class LiveSource : public Source {
 public:
  struct Start {
    RunAbout about;
    std::string robots_json;
    std::vector<std::string> robots;  ///< Names, by slot.
    std::vector<std::pair<std::uint32_t, std::string>> bodies;
    std::shared_ptr<ProbeDesk> probes;  ///< Null: no virtual sensors can be tried.
    std::filesystem::path scenario;     ///< Its file, which may list other panels; may be empty.

    /// What the scenario and the run say before the first step. Errors: those of components_of().
    [[nodiscard]] static Result<Start> of(const config::ExpandedScenario& scenario,
                                          const record::RunInfo& run,
                                          const record::StringMap& hybrids,
                                          const sim::EngineSpec& spec);
  };
  LiveSource(Start start, std::shared_ptr<LiveBox> box, std::unique_ptr<RunPort> port);

  [[nodiscard]] const RunAbout& about() const noexcept override { return start_.about; }
  [[nodiscard]] Powers powers() const override;
  [[nodiscard]] Status refresh_components() override;
  [[nodiscard]] const std::string& bodies_json() const noexcept override { return bodies_json_; }
  [[nodiscard]] const std::string& robots_json() const noexcept override {
    return start_.robots_json;
  }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override {
    return static_cast<std::uint32_t>(start_.robots.size());
  }
  [[nodiscard]] std::span<const LogEvent> events() const noexcept override {
    return fold_.events();
  }
  [[nodiscard]] std::unique_ptr<Cursor> open_cursor() override;
  [[nodiscard]] std::unique_ptr<Playhead> open_playhead() override;
  [[nodiscard]] int bell() const noexcept override { return box_->bell.descriptor(); }
  void tick(Playhead::Clock::time_point now, const Audience& audience) override;
  [[nodiscard]] std::uint64_t events_revision() const noexcept override { return fold_.revision(); }
  [[nodiscard]] std::size_t events_changed_since(std::uint64_t revision) const noexcept override {
    return fold_.changed_since(revision);
  }
  [[nodiscard]] std::uint64_t bodies_revision() const noexcept override { return bodies_revision_; }
  [[nodiscard]] std::string bodies_changed_since(std::uint64_t revision) const override;
  [[nodiscard]] std::uint64_t hosts_revision() const noexcept override {
    return own_host_.revision() > 0 ? own_host_.revision() : picture().hosts_revision;
  }
  [[nodiscard]] const std::string& hosts_json() const noexcept override {
    return own_host_.revision() > 0 ? own_host_.json() : picture().hosts;
  }
  [[nodiscard]] std::vector<MapName> map_names() const override { return maps_.names(); }
  [[nodiscard]] std::uint64_t map_names_revision() const noexcept override {
    return maps_.names_revision();
  }
  [[nodiscard]] std::uint64_t maps_revision() const noexcept override { return maps_.revision(); }
  [[nodiscard]] const MapShown* map(const MapName& name) const override { return maps_.find(name); }
  [[nodiscard]] std::string virtual_sensors_json() override {
    return start_.probes ? start_.probes->catalogue_json() : "[]";
  }
  [[nodiscard]] Result<ProbeMade> probe(const ProbeRequest& request) override;
  void keep_chat(const ChatText& said) override;
  void halt(const HaltMessage& halt, const Author& author, Reply reply) override;
  void command(const CommandMessage& command, const Author& author,
               const SlotReply& reply) override;
  [[nodiscard]] std::uint64_t leases_revision() const noexcept override { return leases_revision_; }
  [[nodiscard]] std::vector<DriveState> leases_changed_since(std::uint64_t revision) const override;

  /// Nothing more comes; `reason` for people. Any thread.
  void end(std::string reason);

  // For its cursors and playheads.
  [[nodiscard]] const LivePicture& picture() const noexcept { return box_->pictures.value(); }
  /// The newest poses.
  [[nodiscard]] const PosesAt& poses() const noexcept { return poses_; }
  /// Poses of the last 20 s, for trails; older ones first.
  [[nodiscard]] const std::deque<PosesAt>& past() const noexcept { return past_; }
  [[nodiscard]] const PlayState& state() const noexcept { return state_; }
  std::string take(const TransportMessage& transport);

 private:
  struct Asked {
    std::future<Result<std::string>> answer;
    Reply reply;
  };
  struct BodyChange {
    std::uint64_t revision = 0;
    std::uint32_t id = 0;
    std::string json;  ///< Empty: it went.
  };
  [[nodiscard]] bool paused() const;
  void take_news();
  [[nodiscard]] bool shows_other(const LivePicture& next);
  void take_picture(Playhead::Clock::time_point now);
  void write_bodies();
  void answer_asked();
  void learn_status(Playhead::Clock::time_point now);
  void learn_leases(const runtime::RunStatus::Robot& robot, std::uint32_t slot);

  Start start_;
  std::shared_ptr<LiveBox> box_;
  std::unique_ptr<RunPort> port_;
  std::string bodies_json_;
  std::vector<BodyChange> body_changes_;
  std::uint64_t bodies_revision_ = 0;
  EventFold fold_;
  SetValues set_values_;
  ComponentWatch component_watch_;
  MapBook maps_;
  PosesAt poses_;
  OwnHost own_host_;
  /// Which readings the last picture had, and of which time.
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, double>> shown_readings_;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, double>> next_readings_;
  std::map<std::string, std::uint32_t, std::less<>> slots_;
  Playhead::Clock::time_point status_at_{};
  std::vector<runtime::RunStatus::Robot> known_robots_;  ///< As of the last status.
  std::vector<DriveState> leases_;                       ///< By robot.
  std::vector<std::uint64_t> leases_changed_;
  std::uint64_t leases_revision_ = 1;
  std::deque<PosesAt> past_;
  PlayState state_;
  Audience wants_;
  std::vector<Asked> asked_;
  Playhead::Clock::time_point measured_at_{};
  double measured_s_ = 0;
  std::mutex mutex_;
  bool ended_ = false;        ///< Guarded by the mutex.
  std::string end_reason_{};  ///< Guarded by the mutex.
};

}  // namespace rave::gui_server
