// SPDX-License-Identifier: Apache-2.0
// rave-carmen-map LOG FOV_DEG YAW_DEG OUTPUT [RESOLUTION_M] [NO_RETURN_M] [front|rear]
//
// Makes a map for ROS `map_server`, OUTPUT.pgm and OUTPUT.yaml, out of the scans and poses of a
// CARMEN log (README.md of drivers/carmen). FOV_DEG and YAW_DEG say where the beams point, as for
// the driver carmen_laser. The same log gives the same bytes.
#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "carmen_map/build_map.hpp"
#include "rave/base/file.hpp"
#include "recording/tokens.hpp"

namespace rave::tools {
namespace {

constexpr const char* kUsage =
    "usage: rave-carmen-map LOG FOV_DEG YAW_DEG OUTPUT [RESOLUTION_M] [NO_RETURN_M] [front|rear]\n"
    "writes OUTPUT.pgm and OUTPUT.yaml\n"
    "FOV_DEG      from the first beam to the last; 0: as the rows of the log say\n"
    "YAW_DEG      of the middle of the field, from the x axis of the logged pose\n"
    "NO_RETURN_M  the range that the log writes for no return; -1: found in the log; 0: none\n"
    "exit code: 0; 1 if there is no map, or one of fewer than ten scans or less than half of "
    "those\n"
    "of the log; 2 for a wrong number of words\n";

Result<double> number(const char* name, const char* text, double least, double most) {
  const auto value = recording::parse_number<double>(text);
  if (value && *value >= least && *value <= most) return *value;
  return fail(ErrorCode::kInvalidArgument, "{} is `{}`: expected a number from {} to {}", name,
              recording::shown(text), least, most);
}

Result<MapOptions> read_options(int count, const char* const* words) {
  MapOptions options;
  options.log = words[1];
  RAVE_TRY_ASSIGN(options.fov_deg, number("FOV_DEG", words[2], 0, 360));
  RAVE_TRY_ASSIGN(options.yaw_deg, number("YAW_DEG", words[3], -360, 360));
  if (count > 5) {
    RAVE_TRY_ASSIGN(options.resolution_m, number("RESOLUTION_M", words[5], 0.005, 10));
  }
  if (count > 6) {
    RAVE_TRY_ASSIGN(options.no_return_m, number("NO_RETURN_M", words[6], -1, 1000));
  }
  const std::string side = count > 7 ? words[7] : "front";
  if (side == "rear") options.side = carmen::LaserSide::kRear;
  if (side == "front" || side == "rear") return options;
  return fail(ErrorCode::kInvalidArgument, "`{}`: expected front or rear", recording::shown(side));
}

Status make_map(int count, const char* const* words) {
  RAVE_TRY_ASSIGN(const MapOptions options, read_options(count, words));
  const std::filesystem::path output = words[4];
  const std::string image = output.filename().string() + ".pgm";
  RAVE_TRY_ASSIGN(const MapFiles files, build_map(options, image));
  RAVE_TRY(write_file_atomically(output.parent_path() / image, files.image));
  RAVE_TRY(write_file_atomically(output.string() + ".yaml", files.yaml));
  for (const std::string& note : files.notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print("{}\n", files.summary);
  if (files.poor.empty()) return {};
  return fail(ErrorCode::kParse, "{}", files.poor);
}

}  // namespace
}  // namespace rave::tools

int main(int argc, char** argv) {
  if (argc < 5 || argc > 8) {
    std::fputs(rave::tools::kUsage, stderr);
    return 2;
  }
  const rave::Status done = rave::tools::make_map(argc, argv);
  if (done) return 0;
  fmt::print(stderr, "rave-carmen-map: {}\n", done.error().text());
  return 1;
}
