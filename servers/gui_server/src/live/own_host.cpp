// SPDX-License-Identifier: Apache-2.0
#include "live/own_host.hpp"

#include <unistd.h>

#include "live/hosts_json.hpp"

namespace rave::gui_server {

void OwnHost::look(Clock::time_point now, const std::string& name, std::uint64_t step,
                   const runtime::RunStatus& status) {
  // As often as the rows of hosts on the bus.
  constexpr auto kInterval = std::chrono::seconds(1);
  // Before the run begins it does not know its robots.
  if (now < next_ || status.scenario.empty()) return;
  next_ = now + kInterval;
  watch::RunView view;
  watch::HostView& host =
      view.hosts.emplace_back(row_.row(name, static_cast<std::uint32_t>(::getpid()), status));
  host.step = step;
  const auto now_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(now.time_since_epoch()).count();
  steps_.add(now_ns, static_cast<double>(step));
  host.rate_hz = steps_.at(now_ns);
  std::string json = hosts_json(view);
  if (json == json_) return;
  json_ = std::move(json);
  ++revision_;
}

}  // namespace rave::gui_server
