// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/bus_options.hpp"

#include <algorithm>
#include <string_view>

#include "rave/base/names.hpp"

namespace rave::bus {
namespace {

Result<Multicast> read_multicast(const std::string& word) {
  if (const auto use = multicast_of(word)) return *use;
  const std::vector<std::string_view> names(kMulticastNames.begin(), kMulticastNames.end());
  return fail(ErrorCode::kInvalidArgument, "--multicast: found `{}`{}", word,
              suggestion(word, names));
}

}  // namespace

bool BusOptions::says_where() const {
  const BusOptions usual;
  return domain != usual.domain || interface != usual.interface || peers != usual.peers ||
         multicast != usual.multicast || security != usual.security;
}

Result<BusConfig> bus_config(const BusOptions& options, std::string participant,
                             std::uint64_t scenario) {
  RAVE_TRY_ASSIGN(auto config, read_bus_options(options, std::move(participant), scenario));
  RAVE_TRY(validate(config));
  return config;
}

Result<BusConfig> read_bus_options(const BusOptions& options, std::string participant,
                                   std::uint64_t scenario) {
  BusConfig config;
  config.participant = std::move(participant);
  config.domain = options.domain;
  config.interface = options.interface;
  config.peers = options.peers;
  config.security = options.security;
  config.tag = options.tag;
  config.local_transport = !options.dds_only;
  RAVE_TRY_ASSIGN(config.multicast, read_multicast(options.multicast));
  const auto digits = RunId::parse(options.run);
  config.run = digits                ? *digits
               : options.run.empty() ? run_of_number(scenario)
                                     : run_of_name(options.run);
  return config;
}

void make_room(BusConfig& config, std::size_t hosts, Reach reach) {
  // The manager, and monitors such as `rave top`: each of them is a participant, too.
  constexpr std::size_t kOthers = 14;
  constexpr std::size_t kMost = BusConfig::kMostPlain;
  const bool crowd = hosts + kOthers > static_cast<std::size_t>(config.max_processes);
  if (!crowd) return;
  config.max_processes = static_cast<int>(std::min(hosts + kOthers, kMost));
  config.reach = reach;
}

std::vector<std::string> words_of(const BusOptions& options, const RunId& run) {
  std::vector<std::string> words = {
      "--run",       run.text(),        "--domain",    std::to_string(options.domain),
      "--interface", options.interface, "--multicast", options.multicast};
  for (const std::string& peer : options.peers) words.insert(words.end(), {"--peer", peer});
  if (!options.security.empty()) words.insert(words.end(), {"--security", options.security});
  if (options.dds_only) words.emplace_back("--dds-only");
  if (!options.tag.empty()) words.insert(words.end(), {"--bus-tag", options.tag});
  return words;
}

}  // namespace rave::bus
