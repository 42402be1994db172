// SPDX-License-Identifier: Apache-2.0
#include "wrong_host.hpp"

#include "onlooker.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::cli_test {

Result<std::unique_ptr<WrongHost>> WrongHost::open(const bus::RunId& run,
                                                   const std::vector<std::string>& apart,
                                                   std::uint32_t host) {
  RAVE_TRY_ASSIGN(auto bus, join_as_onlooker(run, apart));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto own_info, bus::Writer<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto reports, bus::Writer<bus::HostReport>::create(*bus));
  return std::unique_ptr<WrongHost>(new WrongHost(host, std::move(bus), std::move(infos),
                                                  std::move(own_info), std::move(reports)));
}

bool WrongHost::introduce() {
  bool met = false;
  infos_.take([&](const bus::HostInfo& manager) {
    if (manager.host != rave_wire_kNone) return;
    bus::HostInfo info = manager;
    info.host = host_;
    bus::put_text(info.name, "wrong");
    met = static_cast<bool>(own_info_.write(info));
  });
  return met;
}

Status WrongHost::say(const sim::HostReport& report, std::uint64_t epoch) {
  return reports_.write(message_.fill(report, epoch, 0));
}

}  // namespace rave::cli_test
