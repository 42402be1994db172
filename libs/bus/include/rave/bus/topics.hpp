// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "idl/rave/command.h"
#include "idl/rave/host.h"
#include "idl/rave/host_results.h"
#include "idl/rave/line.h"
#include "idl/rave/lock_step.h"
#include "idl/rave/look.h"
#include "idl/rave/map.h"
#include "idl/rave/obstacle.h"
#include "idl/rave/request.h"
#include "idl/rave/roster.h"
#include "idl/rave/world.h"
#include "rave/bus/qos.hpp"

namespace rave::bus {

using HostReport = rave_wire_HostReport;
using WorldStep = rave_wire_WorldStep;
/// The last world that a host received, sent to a manager that restarts. Same type, another topic.
struct LastWorld : rave_wire_WorldStep {};
using RunState = rave_wire_RunState;
/// The state of the run as one host knows it. Same type, another topic.
struct HostRun : rave_wire_RunState {};
using HostState = rave_wire_HostState;
using World = rave_wire_World;
using RosterEntry = rave_wire_RosterEntry;
using Obstacle = rave_wire_Obstacle;
/// An obstacle that a host sends to a manager that restarts. Same type, another topic.
struct LastObstacle : rave_wire_Obstacle {};
using Command = rave_wire_Command;
using CommandAnswer = rave_wire_CommandAnswer;
using Packet = rave_wire_Packet;
using HostInfo = rave_wire_HostInfo;
using ProcessState = rave_wire_ProcessState;
using LifeSign = rave_wire_LifeSign;
using ClockPing = rave_wire_ClockPing;
using ClockPong = rave_wire_ClockPong;
using LineInfo = rave_wire_LineInfo;
using LineWithdrawal = rave_wire_LineWithdrawal;
using HostResultsPart = rave_wire_HostResultsPart;
using Look = rave_wire_Look;
using Readings = rave_wire_Readings;
using RunEvents = rave_wire_RunEvents;
using MapTile = rave_wire_MapTile;
using Request = rave_wire_Request;
using RequestAnswer = rave_wire_RequestAnswer;

/// The name, type and QoS of a topic.
struct TopicSpec {
  const char* name = nullptr;
  const dds_topic_descriptor_t* type = nullptr;
  QosProfile qos{};
  /// Its number on the local transport (local_transport.hpp); 0: DDS only. Only for topics whose
  /// readers tolerate loss, duplicates and reordering.
  std::uint8_t local_transport = 0;
};

/// The topic of a message type. Names and QoS of all topics are defined here only; the table in
/// docs/reference/bus.md repeats them.
template <class Message>
inline constexpr TopicSpec kTopic{};

template <>
inline constexpr TopicSpec kTopic<HostReport> = {"rave/host_report", &rave_wire_HostReport_desc,
                                                 kNewest, 1};
template <>
inline constexpr TopicSpec kTopic<WorldStep> = {"rave/world_step", &rave_wire_WorldStep_desc,
                                                kNewest, 2};
template <>
inline constexpr TopicSpec kTopic<LastWorld> = {"rave/last_world", &rave_wire_WorldStep_desc,
                                                kNewest};
template <>
inline constexpr TopicSpec kTopic<RunState> = {"rave/run", &rave_wire_RunState_desc, kIntroduction};
template <>
inline constexpr TopicSpec kTopic<HostRun> = {"rave/host_run", &rave_wire_RunState_desc, kNewest};
template <>
inline constexpr TopicSpec kTopic<HostState> = {"rave/host_state", &rave_wire_HostState_desc,
                                                kLately};
template <>
inline constexpr TopicSpec kTopic<World> = {"rave/world", &rave_wire_World_desc, kNewest};
template <>
inline constexpr TopicSpec kTopic<RosterEntry> = {"rave/roster", &rave_wire_RosterEntry_desc,
                                                  kRoster};
template <>
inline constexpr TopicSpec kTopic<Obstacle> = {"rave/obstacle", &rave_wire_Obstacle_desc, kDurable};
template <>
inline constexpr TopicSpec kTopic<LastObstacle> = {"rave/last_obstacle", &rave_wire_Obstacle_desc,
                                                   kDurable};
template <>
inline constexpr TopicSpec kTopic<Command> = {"rave/command", &rave_wire_Command_desc, kRecent};
template <>
inline constexpr TopicSpec kTopic<CommandAnswer> = {"rave/command_answer",
                                                    &rave_wire_CommandAnswer_desc, kRecent};
template <>
inline constexpr TopicSpec kTopic<Packet> = {"rave/radio", &rave_wire_Packet_desc, kCrowd};
template <>
inline constexpr TopicSpec kTopic<HostInfo> = {"rave/host", &rave_wire_HostInfo_desc,
                                               kIntroduction};
template <>
inline constexpr TopicSpec kTopic<LifeSign> = {"rave/life_sign", &rave_wire_LifeSign_desc,
                                               kDescription};
template <>
inline constexpr TopicSpec kTopic<ProcessState> = {"rave/process", &rave_wire_ProcessState_desc,
                                                   kNewest};
template <>
inline constexpr TopicSpec kTopic<ClockPing> = {"rave/clock_ping", &rave_wire_ClockPing_desc,
                                                kOnce};
template <>
inline constexpr TopicSpec kTopic<ClockPong> = {"rave/clock_pong", &rave_wire_ClockPong_desc,
                                                kOnce};
template <>
inline constexpr TopicSpec kTopic<LineInfo> = {"rave/line", &rave_wire_LineInfo_desc, kDurable};
template <>
inline constexpr TopicSpec kTopic<LineWithdrawal> = {"rave/withdrawal",
                                                     &rave_wire_LineWithdrawal_desc, kDurable};
template <>
inline constexpr TopicSpec kTopic<HostResultsPart> = {"rave/host_results",
                                                      &rave_wire_HostResultsPart_desc, kDurable};
template <>
inline constexpr TopicSpec kTopic<Look> = {"rave/look", &rave_wire_Look_desc, kNewest};
template <>
inline constexpr TopicSpec kTopic<Readings> = {"rave/readings", &rave_wire_Readings_desc, kNewest};
template <>
inline constexpr TopicSpec kTopic<RunEvents> = {"rave/events", &rave_wire_RunEvents_desc, kPast};
template <>
inline constexpr TopicSpec kTopic<MapTile> = {"rave/map", &rave_wire_MapTile_desc, kDescription};
template <>
inline constexpr TopicSpec kTopic<Request> = {"rave/request", &rave_wire_Request_desc, kRecent};
template <>
inline constexpr TopicSpec kTopic<RequestAnswer> = {"rave/answer", &rave_wire_RequestAnswer_desc,
                                                    kRecent};

template <class Message>
[[nodiscard]] constexpr const TopicSpec& topic_of() {
  static_assert(kTopic<Message>.name != nullptr, "this message has no topic");
  return kTopic<Message>;
}

}  // namespace rave::bus
