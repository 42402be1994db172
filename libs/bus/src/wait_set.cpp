// SPDX-License-Identifier: Apache-2.0
// Waits for samples, events, a bell and a stop. Without a local transport one call of DDS does all
// of it; otherwise the relay does.
#include "rave/bus/wait_set.hpp"

#include <array>
#include <utility>

#include "participants.hpp"
#include "rave/bus/local_transport.hpp"
#include "relay.hpp"

namespace rave::bus {
namespace {

Status done(dds_return_t code) {
  if (code >= 0) return {};
  return fail(ErrorCode::kIo, "cannot wait: {}", dds_strretcode(code));
}

}  // namespace

// Here, where the relay is a complete type.
WaitSet::WaitSet() = default;

Result<WaitSet> WaitSet::create(Bus& bus) {
  WaitSet set;
  set.bus_ = &bus;
  set.set_ = dds_create_waitset(bus.participant_);
  set.stop_ = dds_create_guardcondition(bus.participant_);
  set.bell_ = dds_create_guardcondition(bus.participant_);
  for (const dds_entity_t entity : {set.set_, set.stop_, set.bell_}) RAVE_TRY(done(entity));
  RAVE_TRY(set.attach(set.stop_));
  RAVE_TRY(set.attach(set.bell_));
  return set;
}

WaitSet::WaitSet(WaitSet&& other) noexcept { *this = std::move(other); }

WaitSet& WaitSet::operator=(WaitSet&& other) noexcept {
  std::swap(bus_, other.bus_);
  std::swap(set_, other.set_);
  std::swap(stop_, other.stop_);
  std::swap(bell_, other.bell_);
  std::swap(relay_, other.relay_);
  std::swap(conditions_, other.conditions_);
  return *this;
}

WaitSet::~WaitSet() {
  relay_.reset();
  if (set_ > 0) dds_delete(set_);
  if (stop_ > 0) dds_delete(stop_);
  if (bell_ > 0) dds_delete(bell_);
  for (const dds_entity_t condition : conditions_) dds_delete(condition);
}

Status WaitSet::attach(dds_entity_t entity) {
  return done(dds_waitset_attach(set_, entity, entity));
}

Status WaitSet::add_reader(dds_entity_t reader) {
  const Bus::Endpoint* const endpoint = bus_->endpoint(reader);
  // Where samples stay after they were read, only the others are news.
  const bool stay = endpoint != nullptr && endpoint->recalls;
  const dds_entity_t condition = dds_create_readcondition(
      reader, DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE |
                  (stay ? DDS_NOT_READ_SAMPLE_STATE : DDS_ANY_SAMPLE_STATE));
  RAVE_TRY(done(condition));
  conditions_.push_back(condition);
  RAVE_TRY(attach(condition));
  if (endpoint == nullptr || !endpoint->receiver) return {};
  // DDS and sockets cannot be waited for in one call. Where a reader has a socket, a relay waits
  // for DDS in a thread and makes it a descriptor.
  if (!relay_) {
    RAVE_TRY_ASSIGN(relay_, Relay::create(set_, bell_));
  }
  relay_->add(*endpoint->receiver);
  return {};
}

Status WaitSet::add_events() {
  for (const dds_entity_t reader : bus_->participants_->readers()) RAVE_TRY(add_reader(reader));
  RAVE_TRY(attach(bus_->participants_->life_signs()));
  for (const Bus::Endpoint& endpoint : bus_->endpoints_) RAVE_TRY(attach(endpoint.entity));
  return {};
}

void WaitSet::ring() const noexcept { dds_set_guardcondition(bell_, true); }

Woken WaitSet::wait(Duration timeout, const std::stop_token& stop) {
  auto came = Relay::Came::kNothing;
  // Before and after: a gap that is longer than the wait means that this process did not run.
  bus_->participants_->standstill().look();
  bus_->participants_->beat();
  {
    const std::stop_callback wake(stop, [this] { dds_set_guardcondition(stop_, true); });
    std::array<dds_attach_t, 1> woken{};
    if (relay_) {
      came = relay_->wait(timeout);
    } else if (dds_waitset_wait(set_, woken.data(), woken.size(),
                                timeout.ns < 0 ? DDS_INFINITY : timeout.ns) > 0) {
      came = Relay::Came::kSet;
    }
  }
  bus_->participants_->standstill().look(timeout);
  // The token is not used any more: the next wait may have another one.
  if (stop.stop_requested()) dds_set_guardcondition(stop_, false);
  // A caller that rings later has finished its work before the caller of wait() looks again. If a
  // datagram came first, the bell ends the next wait.
  bool rung = false;
  if (came != Relay::Came::kSocket) static_cast<void>(dds_take_guardcondition(bell_, &rung));
  if (rung && came == Relay::Came::kNothing) came = Relay::Came::kSet;
  if (stop.stop_requested()) return Woken::kStopped;
  return came != Relay::Came::kNothing ? Woken::kReady : Woken::kTimeout;
}

}  // namespace rave::bus
