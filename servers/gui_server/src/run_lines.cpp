// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/run_lines.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rave/bus/run_id.hpp"

namespace rave::gui_server {
namespace {

constexpr const char* kHere = "this process";

std::vector<std::string> names_of(const config::ExpandedScenario& scenario,
                                  const config::PlannedHost& host) {
  std::vector<std::string> names;
  for (const std::size_t robot : host.robots) names.push_back(scenario.robots[robot].name);
  return names;
}

}  // namespace

Result<std::unique_ptr<direct_line::LineServer>> open_line_here(
    direct_line::LineOptions options, const config::ExpandedScenario& scenario,
    runtime::RunControl& control, GuiServer& page) {
  // Page and line are in this process, so no other process needs the key and it need not be a file.
  const direct_line::SigningKey key = direct_line::new_signing_key();
  options.signer = key.open;
  // A run of one process has no number on a bus; tickets need one all the same, so that none fits
  // another run.
  options.run = bus::RunId::random().text();
  options.host = kHere;
  RAVE_TRY_ASSIGN(auto server, direct_line::LineServer::start(options, control));
  direct_line::HostLine line{kHere, server->url(), {}};
  for (const config::ExpandedRobot& robot : scenario.robots) line.robots.push_back(robot.name);
  page.offer_lines(direct_line::lines_here(*server, options.run, std::move(line)), key);
  return server;
}

Status offer_bus_lines(const config::ExpandedScenario& scenario, const bus::BusConfig& bus,
                       const direct_line::SigningKey& key, GuiServer& page) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::map<std::string, std::vector<std::string>> robots;
  for (const config::PlannedHost& host : hosts) robots[host.name] = names_of(scenario, host);
  RAVE_TRY_ASSIGN(
      auto lines,
      direct_line::lines_on_bus(bus, [robots = std::move(robots)](const std::string& host) {
        const auto found = robots.find(host);
        return found == robots.end() ? std::vector<std::string>() : found->second;
      }));
  page.offer_lines(std::move(lines), key);
  return {};
}

}  // namespace rave::gui_server
