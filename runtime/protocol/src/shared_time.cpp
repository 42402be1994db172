// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/shared_time.hpp"

namespace rave::real_time {

void SharedTime::begin_alone(std::int64_t local_ns) {
  zero_ns_ = local_ns;
  known_ = true;
}

Status SharedTime::hear(std::uint64_t manager, const bus::ClockExchange& exchange, bool begun,
                        std::int64_t zero_ns) {
  if (manager != manager_) {
    // A first answer that makes no sense must not replace what is known from the manager before.
    RAVE_TRY(bus::read_clock(exchange));
    offset_ = bus::ClockOffset();
    manager_ = manager;
  }
  RAVE_TRY(offset_.add(exchange));
  const auto reading = offset_.at(exchange.heard_ns);
  if (!begun || !reading) return {};
  known_ = true;
  // remote = local + offset, so the same moment on the local clock is remote minus offset.
  zero_ns_ = zero_ns - reading->offset.ns;
  return {};
}

}  // namespace rave::real_time
