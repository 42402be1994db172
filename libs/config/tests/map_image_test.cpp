// SPDX-License-Identifier: Apache-2.0
#include "rave/config/map_image.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <fstream>

#include "rave/base/random.hpp"

namespace rave::config {
namespace {

constexpr std::string_view kYaml =
    "image: m.pgm\nresolution: 0.5\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A folder of its own, removed at the end.
class MapFolder : public testing::Test {
 protected:
  MapFolder()
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("rave_map_{}_{}", ::getpid(),
                            testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, std::string_view content) const {
    std::ofstream(path(name), std::ios::binary) << content;
  }
  /// The error of reading the map with the folder's name cut out.
  [[nodiscard]] std::string error() const {
    const auto map = read_map(path("m.yaml"));
    if (map) return "none";
    std::string text = map.error().text();
    const std::string prefix = folder_.string() + "/";
    while (text.find(prefix) != std::string::npos) text.erase(text.find(prefix), prefix.size());
    return text;
  }

 private:
  std::filesystem::path folder_;
};

std::string states(const MapImage& map) {
  std::string text;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      text += ".#?"[static_cast<int>(map.at(column, row))];
    }
    text += '/';
  }
  return text;
}

std::string with(std::string_view from, std::string_view to) {
  std::string yaml(kYaml);
  return yaml.replace(yaml.find(from), from.size(), to);
}

TEST_F(MapFolder, TrinaryByTheRuleOfMapServer) {
  write("m.yaml", kYaml);
  // p: 1, 0.66, 0.65 (not above), 0.2, 0.196 (205: not below is 0.19608), 0.
  write("m.pgm", "P2 # a comment\n# another\n3 2\n255\n0 86 90\n204 206 255\n");
  const auto map = read_map(path("m.yaml"));
  ASSERT_TRUE(map.has_value()) << map.error().text();
  EXPECT_EQ(states(*map), "##?/?../");
  EXPECT_EQ(map->resolution_m, 0.5);
  EXPECT_EQ(map->origin_x_m, -1);
  EXPECT_EQ(map->origin_y_m, -2);
}

TEST_F(MapFolder, NegatedAndRaw) {
  write("m.pgm", "P2 3 1 255 0 80 255");
  write("m.yaml", with("negate: 0", "negate: 1"));
  EXPECT_EQ(states(read_map(path("m.yaml")).value()), ".?#/");
  write("m.yaml", with("negate: 0", "negate: 0\nmode: raw"));
  EXPECT_EQ(states(read_map(path("m.yaml")).value()), ".#?/");
}

/// A PNG of 2 x 1 pixels made by libpng's simplified writer.
std::string make_png(std::uint32_t format, std::vector<std::uint8_t> pixels,
                     const std::vector<std::uint8_t>& colours = {}) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 1;
  image.format = format;
  image.colormap_entries = static_cast<png_uint_32>(colours.size() / 3);
  std::string bytes(4096, '\0');
  png_alloc_size_t size = bytes.size();
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0,
                                      colours.empty() ? nullptr : colours.data()),
            0)
      << image.message;
  bytes.resize(size);
  return bytes;
}

TEST_F(MapFolder, TransparentIsUnknownInModeScaleOnly) {
  write("m.pgm", make_png(PNG_FORMAT_RGBA, {0, 0, 0, 255, 0, 0, 0, 0}));
  write("m.yaml", with("negate: 0", "negate: 0\nmode: scale"));
  EXPECT_EQ(states(read_map(path("m.yaml")).value()), "#?/");
  write("m.yaml", kYaml);
  EXPECT_EQ(states(read_map(path("m.yaml")).value()), "##/");
}

TEST_F(MapFolder, RectanglesAreInMetresWithYUp) {
  write("m.yaml", kYaml);
  write("m.pgm", "P2 3 2 255 0 0 255 255 255 0");
  const auto all = rectangles_of(read_map(path("m.yaml")).value());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].min_x_m, 0);
  EXPECT_EQ(all[0].max_x_m, 1);
  EXPECT_EQ(all[0].min_y_m, 0.5);
  EXPECT_EQ(all[0].max_y_m, 1);
  EXPECT_EQ(all[1].min_x_m, 1);
  EXPECT_EQ(all[1].max_y_m, 0.5);
  EXPECT_EQ(all[1].min_y_m, 0);
}

TEST_F(MapFolder, KeysThatRosIgnoresAreIgnoredAndTypingErrorsAreNot) {
  write("m.pgm", "P2\n2 1\n255\n0 255\n");
  write("m.yaml", std::string(kYaml) + "width: 2\nname: lab\nlayers: [a, {b: 1}]\nnote: x\n");
  EXPECT_EQ(error(), "none");
  EXPECT_EQ(states(read_map(path("m.yaml")).value()), "#./");
  write("m.yaml", with("negate", "negat"));
  EXPECT_NE(error().find("unknown key `negat`; did you mean `negate`?"), std::string::npos)
      << error();
  write("m.yaml", std::string(kYaml) + "moed: raw\n");
  EXPECT_NE(error().find("unknown key `moed`; did you mean `mode`?"), std::string::npos) << error();
}

TEST_F(MapFolder, FlagsAsPythonWritesThemAndAnImageAtHome) {
  write("m.pgm", "P2\n2 1\n255\n0 255\n");
  for (const auto& [word, expected] :
       {std::pair("False", "#./"), {"FALSE", "#./"}, {"True", ".#/"}, {"true", ".#/"}}) {
    write("m.yaml", with("negate: 0", std::string("negate: ") + word));
    EXPECT_EQ(error(), "none") << word;
    EXPECT_EQ(states(read_map(path("m.yaml")).value()), expected) << word;
  }
  const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  ::setenv("HOME", path("").c_str(), 1);
  std::filesystem::create_directory(path("elsewhere"));
  write("elsewhere/m.yaml", with("m.pgm", "~/m.pgm"));
  EXPECT_TRUE(read_map(path("elsewhere/m.yaml")));
  ::setenv("HOME", before.c_str(), 1);
}

TEST_F(MapFolder, ErrorsNameFileAndReason) {
  EXPECT_EQ(error(), "cannot open `m.yaml`: No such file or directory");
  write("m.yaml", kYaml);
  EXPECT_EQ(error(), "m.yaml:1:8: cannot open `m.pgm`: No such file or directory");
  const std::vector<std::pair<std::string, std::string>> images = {
      {"", "`m.pgm`: the image file is empty"},
      {"GIF89a", "`m.pgm`: neither a PGM (P2, P5) nor a PNG image"},
      {"P5 3", "`m.pgm`: the PGM header is cut or damaged"},
      {"P5 3 x 255\n", "`m.pgm`: the PGM header is cut or damaged"},
      {"P5 0 3 255\n", "`m.pgm`: the image has no pixels (0 x 3)"},
      {"P5 9000 9000 255\n",
       "`m.pgm`: the image is too large (9000 x 9000; at most 64000000 pixels)"},
      {"P5 2 2 0\n1234", "`m.pgm`: the PGM's largest grey value is 0, expected 1 to 65535"},
      {"P5 2 2 255\n123", "`m.pgm`: the image is cut: 3 of 4 bytes"},
      {"P5 2 2 300\n1234567", "`m.pgm`: the image is cut: 7 of 8 bytes"},
      {"P2 2 2 255\n1 2 3", "`m.pgm`: the image is cut: 3 of 4 pixels"},
      {"P2 2 2 255\n1 2 x 4", "`m.pgm`: pixel 3 is not a number from 0 to 255"},
      {"P2 2 2 255\n1 2 256 4", "`m.pgm`: pixel 3 is not a number from 0 to 255"},
      {"\x89PNG\r\n\x1a\n", "`m.pgm`: PNG: the image is cut"}};
  for (const auto& [bytes, message] : images) {
    write("m.pgm", bytes);
    EXPECT_EQ(error(), "m.yaml:1:8: " + message);
  }
  write("m.yaml", with("m.pgm", "."));
  EXPECT_EQ(error(), "m.yaml:1:8: cannot read `.`: it is a folder");
}

TEST_F(MapFolder, TheYamlIsStrict) {
  write("m.pgm", "P2 1 1 255 0");
  const std::vector<std::array<std::string, 3>> changes = {
      {"resolution: 0.5", "resolution: 0",
       "m.yaml:2:13: `resolution`: found the number 0, expected a number (greater than 0 and at "
       "most 1000, in metres)"},
      {"negate: 0", "negate: 2",
       "m.yaml:4:9: `negate`: found the number 2, expected 0, 1, false or true"},
      {"negate: 0", "negate: 0\nmode: grey",
       "m.yaml:5:7: `mode`: found the text \"grey\", expected one of trinary, scale and raw"},
      {"free_thresh: 0.196", "free_thresh: 0.9",
       "m.yaml:6:14: `free_thresh`: found 0.9, expected at most `occupied_thresh` (0.65)"},
      {"[-1.0, -2.0, 0.0]", "[-1.0, -2.0]",
       "m.yaml:3:9: `origin`: found a list of 2 items, expected a list of 3 items, each a number "
       "(from -10000000 to 10000000)"},
      {"negate", "negated",
       "m.yaml:1:1: missing key `negate`: expected 0, 1, false or true\n"
       "m.yaml:4:1: unknown key `negated`; did you mean `negate`?"}};
  for (const auto& [from, to, message] : changes) {
    write("m.yaml", with(from, to));
    EXPECT_EQ(error(), message);
  }
}

TEST(Pgm, SixteenBits) {
  using std::string_literals::operator""s;
  const auto image = decode_pgm("P5\n3 1\n65535\n\x00\x00\x80\x00\xff\xff"s, "x");
  ASSERT_TRUE(image.has_value()) << image.error().text();
  EXPECT_EQ(image->shade, (std::vector<std::uint8_t>{0, 128, 255}));
}

TEST(Png, AllKindsOfPixels) {
  const auto shades = [](const std::string& bytes) { return decode_png(bytes, "x").value().shade; };
  using Shades = std::vector<std::uint8_t>;
  EXPECT_EQ(shades(make_png(PNG_FORMAT_GRAY, {7, 200})), (Shades{7, 200}));
  EXPECT_EQ(shades(make_png(PNG_FORMAT_RGB, {0, 30, 60, 255, 255, 255})), (Shades{30, 255}));
  EXPECT_EQ(shades(make_png(PNG_FORMAT_RGB_COLORMAP, {1, 0}, {0, 0, 0, 90, 0, 0})),
            (Shades{30, 0}));
  const auto alpha = decode_png(make_png(PNG_FORMAT_RGBA, {9, 9, 9, 255, 60, 60, 60, 0}), "x");
  EXPECT_EQ(alpha.value().opaque, (Shades{1, 0}));
  EXPECT_EQ(alpha->shade, (Shades{9, 60}));
}

TEST(Png, EveryCutIsAnError) {
  const std::string whole = make_png(PNG_FORMAT_GRAY, {7, 200});
  for (std::size_t n = 0; n + 13 < whole.size(); ++n) {  // without the closing chunk it is whole
    EXPECT_FALSE(decode_png(whole.substr(0, n), "x").has_value()) << n;
  }
}

TEST(Rectangles, CoverExactlyAndDoNotOverlap) {
  for (std::uint32_t sample = 0; sample < 200; ++sample) {
    RandomStream random(3, 0, 0, sample);
    MapImage map;
    map.width = 1 + static_cast<int>(random.bits() % 20);
    map.height = 1 + static_cast<int>(random.bits() % 20);
    map.resolution_m = 0.05;
    const double density = random.uniform();
    for (int i = 0; i < map.width * map.height; ++i) {
      map.cells.push_back(random.uniform() < density ? CellState::kOccupied : CellState::kFree);
    }
    std::vector<int> covered(map.cells.size());
    for (const CellRectangle& r : cell_rectangles_of(map)) {
      for (int y = r.row; y < r.row + r.height; ++y) {
        for (int x = r.column; x < r.column + r.width; ++x) {
          ++covered.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                       static_cast<std::size_t>(x));
        }
      }
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
      ASSERT_EQ(covered[i], map.cells[i] == CellState::kOccupied ? 1 : 0);
    }
  }
}

TEST(Rectangles, AFullMapIsOne) {
  MapImage map;
  map.width = 5;
  map.height = 4;
  map.cells.assign(20, CellState::kOccupied);
  EXPECT_EQ(cell_rectangles_of(map).size(), 1U);
}

}  // namespace
}  // namespace rave::config
