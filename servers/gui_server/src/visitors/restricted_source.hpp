// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rave/gui_server/source.hpp"
#include "visitors/view.hpp"

namespace rave::gui_server {

/// A run as people with certain rights get it. Sessions are given this in the place of the run, so
/// what is withheld does not even reach the code that encodes. One for all sessions with equal
/// rights. The thread of the server.
class RestrictedSource final : public Source {
 public:
  /// `all` and `view` are shared with those who have other rights.
  RestrictedSource(std::shared_ptr<Source> all, std::shared_ptr<const View> view);

  [[nodiscard]] const RunAbout& about() const noexcept override { return about_; }
  [[nodiscard]] const std::vector<PageComponent>& components() const override {
    return all_->components();
  }
  [[nodiscard]] Powers powers() const override;
  [[nodiscard]] const std::string& bodies_json() const noexcept override;
  [[nodiscard]] std::string hidden_kinds_json() const override;
  [[nodiscard]] const std::string& robots_json() const noexcept override { return robots_json_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override { return view_->robots(); }
  [[nodiscard]] std::span<const LogEvent> events() const noexcept override;
  [[nodiscard]] std::unique_ptr<Cursor> open_cursor() override;
  [[nodiscard]] std::unique_ptr<Playhead> open_playhead() override;
  [[nodiscard]] std::uint64_t events_revision() const noexcept override;
  [[nodiscard]] std::size_t events_changed_since(std::uint64_t revision) const noexcept override;
  [[nodiscard]] std::uint64_t bodies_revision() const noexcept override;
  [[nodiscard]] std::string bodies_changed_since(std::uint64_t revision) const override;
  /// Hosts say how many robots they have, so they are shown to who sees all robots.
  [[nodiscard]] std::uint64_t hosts_revision() const noexcept override;
  [[nodiscard]] const std::string& hosts_json() const noexcept override;
  /// Global maps go to users who get the map of any robot; that of a team to those who get the maps
  /// of that team.
  [[nodiscard]] std::vector<MapName> map_names() const override;
  [[nodiscard]] std::uint64_t map_names_revision() const noexcept override {
    return all_->map_names_revision();
  }
  [[nodiscard]] std::uint64_t maps_revision() const noexcept override {
    return all_->maps_revision();
  }
  [[nodiscard]] const MapShown* map(const MapName& name) const override;
  [[nodiscard]] std::string virtual_sensors_json() override;
  /// Who gets no virtual obstacles senses none.
  [[nodiscard]] Result<ProbeMade> probe(const ProbeRequest& request) override;
  void halt(const HaltMessage& halt, const Author& author, Reply reply) override;
  void command(const CommandMessage& command, const Author& author,
               const SlotReply& reply) override;
  [[nodiscard]] std::uint64_t leases_revision() const noexcept override {
    return all_->leases_revision();
  }
  /// A user who sees a robot sees who drives it; where it is sent and what it takes are rights.
  [[nodiscard]] std::vector<DriveState> leases_changed_since(std::uint64_t revision) const override;

  /// A picture that several pages share is cut down once.
  [[nodiscard]] PosesAt cut(const PosesAt& all);
  /// The same of a message that says which bodies changed; empty: none that is seen.
  [[nodiscard]] std::string cut_bodies(const std::string& change) const;

 private:
  void take_events() const;
  void take_bodies() const;
  [[nodiscard]] bool may_global(const std::string& name) const;

  std::shared_ptr<Source> all_;
  std::shared_ptr<const View> view_;
  RunAbout about_;
  std::string robots_json_;
  PosesAt shared_;  ///< The last shared picture.
  // What is made of the run when it is asked for.
  mutable std::vector<LogEvent> events_;
  mutable std::vector<std::size_t> event_places_;  ///< Of each event, its index in the run.
  mutable std::uint64_t events_revision_ = 0;
  mutable bool has_events_ = false;
  mutable std::string bodies_json_;
  mutable std::uint64_t bodies_revision_ = 0;
  mutable bool has_bodies_ = false;
  mutable std::set<std::int64_t> shown_bodies_;  ///< That were sent to a page, as the run counts.
};

}  // namespace rave::gui_server
