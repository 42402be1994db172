// SPDX-License-Identifier: Apache-2.0
// Which robots hear a message, and when it arrives. Runs on many threads, so it writes only to the
// Reach of its own block.
#include <algorithm>
#include <cmath>

#include "radio.hpp"
#include "rave/base/crash_note.hpp"

namespace rave::sim {
namespace {

Vec2 position(const ReportedPose& pose) { return {pose.pose.x_m, pose.pose.y_m}; }

}  // namespace

void Radio::place(Channel& channel, const RadioMoment& moment) {
  if (channel.placed) return;
  channel.placed = true;
  items_.clear();
  Vec2 low{1e300, 1e300};
  Vec2 high{-1e300, -1e300};
  for (const std::uint32_t e : channel.members) {
    const ReportedPose& pose = moment.reported[endpoints_[e].robot];
    if (!pose.known) continue;
    const Vec2 p_WR = position(pose);
    low = {std::min(low.x, p_WR.x), std::min(low.y, p_WR.y)};
    high = {std::max(high.x, p_WR.x), std::max(high.y, p_WR.y)};
    world::ShapePiece& item = items_.emplace_back();
    item.centre_W = p_WR;
    item.shape = e;
  }
  // Cells as large as the reach of most, but not many more cells than robots.
  const double extent_m = items_.empty() ? 0 : std::max(high.x - low.x, high.y - low.y);
  // With n robots about (4 sqrt(n))^2 = 16 n cells at most.
  const double sparse_m = extent_m / (4 * std::sqrt(static_cast<double>(items_.size()) + 1));
  channel.grid.build(items_, std::max({channel.largest_range_m, sparse_m, 0.1}));
}

void Radio::find_candidates(const StoredPacket& sent, Reach& reach) const {
  const Endpoint& from = endpoints_[sent.endpoint];
  const Recipient& to = sent.head.to;
  const Channel& channel = channels_[from.channel];
  const double range_m = sent.origin.range_m;
  std::vector<std::uint32_t>& found = reach.candidates;
  found.clear();
  if (to.kind == RecipientKind::kRobot) {
    if (to.robot >= spec_.robots.size() || to.robot == from.robot || local_[to.robot] == 0) return;
    for (std::uint32_t e = first_endpoint_[to.robot]; e < first_endpoint_[to.robot + 1]; ++e) {
      const Endpoint& other = endpoints_[e];
      if (other.channel != from.channel || lines_[other.line].declaration.in_process == 0) continue;
      found.push_back(e);
    }
    reach.counts.addressed += found.size();
    return;
  }
  const bool to_team = to.kind == RecipientKind::kTeam;
  if (to_team && from.team == kNobody) return;
  std::size_t all = to_team ? channel.team_sizes[from.team] : channel.members.size();
  if (local_[from.robot] != 0) --all;  // it is a member itself
  if (range_m == 0) {
    found = channel.members;
  } else if (sent.origin.located) {
    // A sender with a range and without a position reaches no receiver.
    channel.grid.for_each_near(sent.origin.p_W, range_m,
                               [&](const world::ShapePiece& item) { found.push_back(item.shape); });
    // By endpoint, as without a grid.
    std::sort(found.begin(), found.end());
  }
  std::erase_if(found, [&](std::uint32_t e) {
    const Endpoint& other = endpoints_[e];
    return other.robot == from.robot || (to_team && other.team != from.team);
  });
  // Those beyond the range are not looked at one by one.
  reach.counts.addressed += all;
  reach.counts.lost_range += all - found.size();
}

void Radio::reach(std::uint32_t packet, const RadioMoment& moment, Reach& reach) const {
  find_candidates(packets_[packet], reach);
  for (const std::uint32_t e : reach.candidates) {
    reach_one(packet, endpoints_[e], e, moment, reach);
  }
}

LinkAnswer Radio::ask(std::uint32_t model, const LinkQuery& query, Reach& reach) const {
  const RadioModel& asked = models_[model];
  LinkAnswer answer;
  answer.arrives = 0;
  if (asked.failed) return answer;
  // A model serves all robots.
  const CrashNote whose{"communicator", asked.spec->driver.c_str(),
                        spec_.robots.front().name.c_str(), spec_.robots.back().name.c_str()};
  const CrashScope scope(whose);
  ErrorText error;
  // The ring of arrivals has room for kMaxSteps; rounding and the step of sending need some of it.
  const double max_delay_s = static_cast<double>(Arrivals::kMaxSteps - 4) * spec_.step.seconds();
  if (asked.spec->ops->link(asked.instance.at(0), &query, &answer, 1, &error) == 0) {
    if (answer.delay_s >= 0 && answer.delay_s <= max_delay_s) return answer;
    *fmt::format_to_n(error.text, sizeof error.text - 1, "gave a delay of {} s", answer.delay_s)
         .out = 0;
  }
  answer.arrives = 0;
  // Kept and told later: this runs on many threads, and events are made on one.
  if (reach.failed_model == kNobody) {
    reach.failed_model = model;
    reach.failure = error.text;
  }
  return answer;
}

std::optional<LinkAnswer> Radio::link(const PacketOrigin& sender, BodyId sender_body,
                                      const Endpoint& to, LinkQuery query,
                                      const RadioMoment& moment, Reach& reach) const {
  const RadioDeclaration& receiver = models_[to.model].declaration;
  const ReportedPose& there = moment.reported[to.robot];
  const bool sight = sender.line_of_sight || receiver.line_of_sight != 0;
  const bool limited = sender.range_m > 0 || receiver.range_m > 0;
  if (sender.located && there.known) {
    query.distance_m = std::sqrt(squared_norm(position(there) - sender.p_W));
  } else if (limited || sight) {
    ++reach.counts.lost_range;
    return std::nullopt;
  }
  if ((sender.range_m > 0 && query.distance_m > sender.range_m) ||
      (receiver.range_m > 0 && query.distance_m > receiver.range_m)) {
    ++reach.counts.lost_range;
    return std::nullopt;
  }
  if (sight) {
    const double z_m = 0.5 * (sender.antenna_z_m + receiver.antenna_z_m);
    const bool visible =
        moment.snapshot->visible(sender.p_W, position(there), z_m, kAllLayers, sender_body,
                                 moment.snapshot->body_of(RobotId(to.robot)));
    query.obstructed = visible ? 0 : 1;
  }
  query.to = to.robot;
  query.seed = spec_.seed;
  const LinkAnswer answer = ask(to.model, query, reach);
  if (answer.arrives != 0) return answer;
  ++(query.obstructed != 0 ? reach.counts.lost_obstacle : reach.counts.lost_chance);
  return std::nullopt;
}

void Radio::reach_one(std::uint32_t packet, const Endpoint& to, std::uint32_t to_index,
                      const RadioMoment& moment, Reach& reach) const {
  const StoredPacket& sent = packets_[packet];
  const Endpoint& from = endpoints_[sent.endpoint];
  LinkQuery query;
  query.bytes = sent.head.size;
  query.from = from.robot;
  query.sequence = sent.head.sequence;
  query.device = LinkQuery::kRadioDevice | from.device;
  const auto answer =
      link(sent.origin, moment.snapshot->body_of(RobotId(from.robot)), to, query, moment, reach);
  if (!answer) return;
  const std::int64_t arrival_ns = sent.complete_ns + from_seconds(answer->delay_s).ns;
  // Rounded up to a step, and never the step in which it was sent: no robot may see in step k what
  // another did in step k.
  const std::int64_t steps = (arrival_ns + spec_.step.ns - 1) / spec_.step.ns;
  reach.arrivals.push_back(std::max(moment.step + 1, static_cast<std::uint64_t>(steps)));
  reach.deliveries.push_back(
      {(std::uint64_t{sent.endpoint} << 32U) | sent.head.sequence, packet, to_index});
}

}  // namespace rave::sim
