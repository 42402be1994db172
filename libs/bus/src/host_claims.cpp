// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/host_claims.hpp"

namespace rave::bus {

Status HostClaims::claim(std::uint32_t host, std::uint64_t writer) {
  const auto [entry, fresh] = writers_.try_emplace(host, writer);
  if (fresh || entry->second == writer) return {};
  return fail(ErrorCode::kState,
              "host {} is served by process {:016x} already, so {:016x} is refused; stop one of "
              "them, or give it another host",
              host, entry->second, writer);
}

void HostClaims::release(std::uint64_t writer) {
  std::erase_if(writers_, [&](const auto& entry) { return entry.second == writer; });
}

std::uint64_t HostClaims::writer_of(std::uint32_t host) const {
  const auto found = writers_.find(host);
  return found == writers_.end() ? 0 : found->second;
}

}  // namespace rave::bus
