// SPDX-License-Identifier: Apache-2.0
#include "commands/map.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "error_text.hpp"
#include "key_watch.hpp"
#include "rave/client/bus_search.hpp"
#include "rave/map_server/map_server.hpp"
#include "rave/maps/map_save.hpp"

namespace rave::cli {
namespace {

constexpr Duration kMapSearch = from_seconds(10);
constexpr Duration kFetch = from_seconds(5);

Result<bus::BusConfig> join(const BusOptions& options, const std::string& word, const char* who,
                            const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(auto config, bus_config(options, who, 0));
  make_room(config, kMostHosts);
  RAVE_TRY_ASSIGN(const bus::RunId run,
                  client::find_bus_run(config, word, client::SearchFor::kLook, kMapSearch, stop));
  config.run = run;
  return config;
}

std::string text_of(const rave::map_server::MapServer::Counts& counts) {
  return fmt::format("maps of {} {}, {} tiles received, {} published", counts.robots,
                     counts.robots == 1 ? "robot" : "robots", counts.received, counts.published);
}

}  // namespace

Result<int> map_server(const MapServerCommand& options) {
  KeyWatch keys(false);
  RAVE_TRY_ASSIGN(const auto config, join(options.bus, options.run, "rave map-server", keys.end()));
  RAVE_TRY_ASSIGN(auto server, rave::map_server::MapServer::open(config));
  put(stdout, "map server: serves until the run ends; Ctrl-C ends it\n");
  std::string told;
  std::size_t robots = 0;
  while (server.serve(from_seconds(1), keys.end()) && !keys.ended()) {
    if (server.problem() != told) {
      told = server.problem();
      put(stderr, "rave: " + told + "\n");
    }
    if (server.counts().robots == robots) continue;
    robots = server.counts().robots;
    put(stdout, "map server: " + text_of(server.counts()) + "\n");
  }
  put(stdout, "map server: ended; " + text_of(server.counts()) + "\n");
  return kGood;
}

Result<int> map_save(const MapSaveCommand& options) {
  KeyWatch keys(false);
  RAVE_TRY_ASSIGN(const auto config, join(options.bus, options.run, "rave map", keys.end()));
  RAVE_TRY_ASSIGN(const auto tiles,
                  rave::map_server::fetch(config, options.map, kFetch, keys.end()));
  std::filesystem::path base = options.file.empty() ? options.map : options.file;
  // The name of one of the two files means both.
  if (base.extension() == ".pgm" || base.extension() == ".yaml") base.replace_extension();
  RAVE_TRY(maps::save(tiles, base));
  const maps::MapFrame& frame = tiles.back().frame;
  put(stdout, fmt::format("{0}.yaml, {0}.pgm: {1} x {2} cells of {3} m\n", base.string(),
                          frame.columns, frame.rows, frame.resolution_m));
  return kGood;
}

}  // namespace rave::cli
