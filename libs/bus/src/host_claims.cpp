// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/host_claims.hpp"

#include <algorithm>

namespace rave::bus {

Status HostClaims::claim(std::uint32_t host, std::uint64_t writer) {
  if (host >= writers_.size()) {
    return fail(ErrorCode::kNotFound, "host {} is not one of the {} of the scenario", host,
                writers_.size());
  }
  // First come, first served. A process that is lost releases its host, so another may take its
  // place.
  std::uint64_t& owner = writers_[host];
  if (owner == 0) owner = writer;
  if (owner == writer) return {};
  return fail(ErrorCode::kState,
              "host {} is already served by process {:016x}, so {:016x} is refused; stop one of "
              "them, or give it another host",
              host, owner, writer);
}

void HostClaims::release(std::uint64_t writer) {
  std::ranges::replace(writers_, writer, std::uint64_t{0});
}

}  // namespace rave::bus
