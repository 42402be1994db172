// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/waiter.hpp"

#include <array>
#include <utility>

namespace rave::ros2 {
namespace {

Result<dds_entity_t> made(dds_entity_t entity) {
  if (entity >= 0) return entity;
  return fail(ErrorCode::kIo, "cannot wait for messages: {}", dds_strretcode(entity));
}

}  // namespace

Result<Waiter> Waiter::create(const Participant& participant) {
  Waiter waiter;
  RAVE_TRY_ASSIGN(waiter.set_, made(dds_create_waitset(participant.handle())));
  RAVE_TRY_ASSIGN(waiter.bell_, made(dds_create_guardcondition(participant.handle())));
  RAVE_TRY(made(dds_waitset_attach(waiter.set_, waiter.bell_, 0)));
  return waiter;
}

Waiter::Waiter(Waiter&& other) noexcept
    : set_(std::exchange(other.set_, 0)), bell_(std::exchange(other.bell_, 0)) {}

Waiter::~Waiter() {
  if (set_ > 0) dds_delete(set_);
  if (bell_ > 0) dds_delete(bell_);
}

Result<dds_entity_t> Waiter::watch(dds_entity_t reader) const {
  // Samples that were read and left there must not wake again.
  constexpr std::uint32_t kUnseen =
      DDS_NOT_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE;
  RAVE_TRY_ASSIGN(const dds_entity_t condition, made(dds_create_readcondition(reader, kUnseen)));
  RAVE_TRY(made(dds_waitset_attach(set_, condition, 0)));
  return condition;
}

void Waiter::forget(dds_entity_t watched) const {
  dds_waitset_detach(set_, watched);
  dds_delete(watched);
}

void Waiter::ring() const noexcept { dds_set_guardcondition(bell_, true); }

void Waiter::wait(Duration limit) const {
  std::array<dds_attach_t, 1> woken{};
  (void)dds_waitset_wait(set_, woken.data(), woken.size(), limit.ns);
  // A caller that rings later has finished its work before the next look of wait()'s caller.
  bool rung = false;
  (void)dds_take_guardcondition(bell_, &rung);
}

}  // namespace rave::ros2
