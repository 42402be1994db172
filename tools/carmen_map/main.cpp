// SPDX-License-Identifier: Apache-2.0
// rave-carmen-map LOG FOV_DEG YAW_DEG OUTPUT [RESOLUTION_M]
//
// Makes a map for ROS `map_server`, OUTPUT.pgm and OUTPUT.yaml, out of the scans and poses of a
// CARMEN log (README.md of drivers/carmen). FOV_DEG and YAW_DEG say where the beams point, as for
// the driver carmen_laser. The same log gives the same bytes.
#include <fmt/format.h>

#include <cstdio>

#include "carmen_map/build_map.hpp"
#include "rave/base/file.hpp"
#include "recording/tokens.hpp"

namespace rave::tools {
namespace {

constexpr const char* kUsage =
    "usage: rave-carmen-map LOG FOV_DEG YAW_DEG OUTPUT [RESOLUTION_M]\n"
    "writes OUTPUT.pgm and OUTPUT.yaml\n";

Result<double> number(const char* name, const char* text, double least, double most) {
  const auto value = recording::parse_number<double>(text);
  if (value && *value >= least && *value <= most) return *value;
  return fail(ErrorCode::kInvalidArgument, "{} is `{}`: expected a number from {} to {}", name,
              recording::shown(text), least, most);
}

Status make_map(int count, const char* const* words) {
  MapOptions options;
  options.log = words[1];
  RAVE_TRY_ASSIGN(options.fov_deg, number("FOV_DEG", words[2], 0.001, 360));
  RAVE_TRY_ASSIGN(options.yaw_deg, number("YAW_DEG", words[3], -360, 360));
  if (count > 5) {
    RAVE_TRY_ASSIGN(options.resolution_m, number("RESOLUTION_M", words[5], 0.005, 10));
  }
  const std::filesystem::path output = words[4];
  const std::string image = output.filename().string() + ".pgm";
  RAVE_TRY_ASSIGN(const MapFiles files, build_map(options, image));
  RAVE_TRY(write_file_atomically(output.parent_path() / image, files.image));
  RAVE_TRY(write_file_atomically(output.string() + ".yaml", files.yaml));
  fmt::print("{}\n", files.summary);
  return {};
}

}  // namespace
}  // namespace rave::tools

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::fputs(rave::tools::kUsage, stderr);
    return 2;
  }
  const rave::Status done = rave::tools::make_map(argc, argv);
  if (done) return 0;
  fmt::print(stderr, "rave-carmen-map: {}\n", done.error().text());
  return 1;
}
