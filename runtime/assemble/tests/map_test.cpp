// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>

#include "rave/assemble_testing/host_fixture.hpp"

namespace rave::runtime::testing {
namespace {

TEST(Build, AMapWithoutAnOccupiedCellIsNamed) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "rave_build_raw";
  std::filesystem::create_directories(folder);
  // Black walls: 0 per cent, if the grey values are taken as they are.
  std::ofstream(folder / "lab.pgm") << "P2 3 1 255 0 255 205";
  const auto notes_with = [&](const std::string& mode) {
    std::ofstream(folder / "lab.yaml")
        << "image: lab.pgm\nresolution: 1\norigin: [50, 50, 0]\nnegate: 0\n"
           "occupied_thresh: 0.65\nfree_thresh: 0.2\nmode: "
        << mode << "\n";
    Host host;
    const auto built = host.build_text(
        "maps: [{file: " + (folder / "lab.yaml").string() + ", z_m: [0, 1]}]\n" +
        scenario_text("  - {name: anna, pose: {}, robot: {" + kBody + ", " + kWheels + "}}\n"));
    EXPECT_TRUE(built.has_value()) << built.error().text();
    return built ? built->notes : std::vector<std::string>();
  };
  EXPECT_EQ(notes_with("trinary"), std::vector<std::string>());
  const std::vector<std::string> notes = notes_with("raw");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("s.yaml:1:15: map `"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("lab.yaml`: none of its 3 x 1 cells is occupied, so it gives no "
                          "obstacle; `mode: raw` takes grey values of 0 to 100"),
            std::string::npos)
      << notes[0];
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rave::runtime::testing
