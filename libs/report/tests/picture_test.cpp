// SPDX-License-Identifier: Apache-2.0
#include "rave/report/picture.hpp"

#include <cairo.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "rave/base/file.hpp"
#include "rave/report/layout.hpp"
#include "sample_picture.hpp"

namespace rave::report {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos;
       at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

/// The pixels of a PNG file, as cairo reads them.
class Pixels {
 public:
  explicit Pixels(const std::filesystem::path& path)
      : surface_(cairo_image_surface_create_from_png(path.c_str())) {}
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;
  ~Pixels() { cairo_surface_destroy(surface_); }
  [[nodiscard]] bool is_good() const {
    return cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS;
  }
  [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_); }
  [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_); }
  /// 0xrrggbb
  [[nodiscard]] std::uint32_t at(Vec2 p) const {
    const unsigned char* data = cairo_image_surface_get_data(surface_);
    const auto x = static_cast<std::ptrdiff_t>(p.x);
    const auto y = static_cast<std::ptrdiff_t>(p.y);
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, data + y * cairo_image_surface_get_stride(surface_) + 4 * x, sizeof pixel);
    return pixel & 0xFFFFFFU;
  }

 private:
  cairo_surface_t* surface_;
};

class PictureTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("rave_picture_test_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string svg_of(const Picture& picture) {
    const auto status = write_svg(picture, folder_ / "a.svg");
    EXPECT_TRUE(status) << (status ? "" : status.error().text());
    return read_file(folder_ / "a.svg").value_or("");
  }
  std::string png_of(const Picture& picture, double scale = 2) {
    const auto status = write_png(picture, folder_ / "a.png", scale);
    EXPECT_TRUE(status) << (status ? "" : status.error().text());
    return read_file(folder_ / "a.png").value_or("");
  }
  /// The message with which a picture is refused; nothing may have been written.
  std::string refusal_of(const Picture& picture) {
    const auto status = write_svg(picture, folder_ / "refused");
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
    if (status) return "accepted";
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
    return status.error().message;
  }
  std::filesystem::path folder_;
};

TEST_F(PictureTest, TheSvgIsWellFormedXml) {
  ASSERT_FALSE(svg_of(sample_picture()).empty());
  const std::string command =
      "python3 -c \"import sys, xml.dom.minidom as m; m.parse(sys.argv[1])\" '" +
      (folder_ / "a.svg").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(PictureTest, TheSvgSaysItsWords) {
  const std::string svg = svg_of(sample_picture());
  EXPECT_NE(svg.find("<title>Robots &amp; &lt;tubes&gt;</title>"), std::string::npos);
  for (const std::string_view words :
       {"a small world", "2 tubes", "mapped wall", "virtual obstacle", "robot 1 (real robot)",
        "odometry alone", "gap in the poses", "robot 1: pose lost at 60.0 s", "tick each 10 s",
        "At t = 40 s", "laser hit on simulated robot", "laser hit on tube", "real sighting",
        "Labels: 17, 18, crate", "Ωμέγα"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(count_of(svg, "laser hit on"), 3U);
}

TEST_F(PictureTest, TheLegendNamesOnlyWhatOccurs) {
  Picture picture = sample_picture();
  picture.tracks.resize(1);
  picture.tracks[0].pose_lost_t_s.reset();
  picture.bodies.resize(1);
  picture.instant->hits.clear();
  picture.instant->sightings.clear();
  const std::string svg = svg_of(picture);
  for (const std::string_view absent : {"odometry", "gap in", "pose lost", "laser hit", "sighting",
                                        "virtual obstacle", "mapped wall"}) {
    EXPECT_EQ(svg.find(absent), std::string::npos) << absent;
  }
}

TEST_F(PictureTest, FewSimulatedRobotsAreNamed) {
  Picture picture = sample_picture();
  picture.tracks.erase(picture.tracks.begin(), picture.tracks.begin() + 3);
  picture.tracks[1].kind = Kind::kSimulatedRobot;
  EXPECT_NE(svg_of(picture).find("2 simulated robots"), std::string::npos);
  Picture nameless = picture;
  for (PictureTrack& track : nameless.tracks) track.label.clear();
  EXPECT_NE(png_of(picture), png_of(nameless));

  picture.tracks[0].colour = "#0072b2";
  picture.tracks[1].colour = "#d55e00";
  const std::string svg = svg_of(picture);
  EXPECT_NE(svg.find("s1 (simulated robot)"), std::string::npos);
  EXPECT_NE(svg.find("chaser (simulated robot)"), std::string::npos);

  while (picture.tracks.size() < 9) picture.tracks.push_back(picture.tracks[0]);
  nameless = picture;
  for (PictureTrack& track : nameless.tracks) track.label.clear();
  EXPECT_EQ(png_of(picture), png_of(nameless)) << "nine names would hide the tracks";
}

// The label of a wall as long as the page is beside the wall: the middle of the room stays white.
TEST_F(PictureTest, LongWallsAreLabelledWhereTheyStand) {
  Picture picture;
  const auto box_W = [](Vec2 c, double half_x, double half_y) {
    return std::vector<Vec2>{c + Vec2{-half_x, -half_y}, c + Vec2{half_x, -half_y},
                             c + Vec2{half_x, half_y}, c + Vec2{-half_x, half_y}};
  };
  picture.bodies = {{box_W({0, -2.05}, 3.1, 0.05), Kind::kVirtualObstacle, "south", ""},
                    {box_W({0, 2.05}, 3.1, 0.05), Kind::kVirtualObstacle, "north", ""},
                    {box_W({-3.05, 0}, 0.05, 2.1), Kind::kVirtualObstacle, "west", ""},
                    {box_W({3.05, 0}, 0.05, 2.1), Kind::kVirtualObstacle, "east", ""}};
  const Panel panel = lay_out(picture).value().panels[0];
  Picture nameless = picture;
  for (PictureBody& body : nameless.bodies) body.label.clear();
  png_of(nameless, 1);
  const Pixels without(folder_ / "a.png");
  png_of(picture, 1);
  const Pixels with(folder_ / "a.png");
  ASSERT_TRUE(with.is_good() && without.is_good());
  std::size_t near = 0;
  for (double x = -2.9; x < 2.9; x += 0.01) {
    for (double y = -1.9; y < 1.9; y += 0.01) {
      const Vec2 at = panel.to_page({x, y});
      if (with.at(at) == without.at(at)) continue;
      EXPECT_TRUE(std::abs(x) > 2.4 || std::abs(y) > 1.7) << x << ", " << y;
      ++near;
    }
  }
  EXPECT_GT(near, 0U);
}

TEST_F(PictureTest, PngHasTheSizeOfTheLayout) {
  const Layout layout = lay_out(sample_picture()).value();
  for (const double scale : {0.5, 1.0, 2.0}) {
    png_of(sample_picture(), scale);
    const Pixels pixels(folder_ / "a.png");
    ASSERT_TRUE(pixels.is_good());
    EXPECT_EQ(pixels.width(), static_cast<int>(std::ceil(layout.width * scale)));
    EXPECT_EQ(pixels.height(), static_cast<int>(std::ceil(layout.height * scale)));
  }
}

TEST_F(PictureTest, BodiesAreWhereTheyShouldBe) {
  const Picture picture = sample_picture();
  const Layout layout = lay_out(picture).value();
  png_of(picture, 2);
  const Pixels pixels(folder_ / "a.png");
  ASSERT_TRUE(pixels.is_good());
  ASSERT_EQ(layout.panels.size(), 2U);
  for (const Panel& panel : layout.panels) {
    // Inside the wall by its colour; just outside, the page is white or grid.
    EXPECT_EQ(pixels.at(2 * panel.to_page({0.15, 2.15})), 0x8C7A66U);
    EXPECT_NE(pixels.at(2 * panel.to_page({0.25, 2.15})), 0x8C7A66U);
    EXPECT_NE(pixels.at(2 * panel.to_page({0.15, 2.25})), 0x8C7A66U);
    EXPECT_NE(pixels.at(2 * panel.to_page({4.2, 1.2})), 0xFFFFFFU);
  }
  // The recorded robot at the instant, beside its heading mark.
  EXPECT_EQ(pixels.at(2 * layout.panels[1].to_page({1.92, 0.88})), 0x0072B2U);
  EXPECT_EQ(pixels.at({2, 2}), 0xFFFFFFU);
}

TEST_F(PictureTest, ACallersColourWins) {
  Picture picture = sample_picture();
  picture.bodies[2].colour = "#12aB34";
  png_of(picture, 2);
  const Pixels pixels(folder_ / "a.png");
  const Panel panel = lay_out(picture).value().panels[0];
  EXPECT_EQ(pixels.at(2 * panel.to_page({0, 2})), 0x12AB34U);
}

TEST_F(PictureTest, EqualInputGivesEqualBytes) {
  const std::string svg = svg_of(sample_picture());
  const std::string png = png_of(sample_picture());
  svg_of(Picture{});
  EXPECT_EQ(svg_of(sample_picture()), svg);
  EXPECT_EQ(png_of(sample_picture()), png);
}

TEST_F(PictureTest, EmptyAndOddPicturesAreDrawn) {
  Picture picture;
  EXPECT_FALSE(svg_of(picture).empty());
  picture.tracks.resize(3);
  picture.tracks[1].points = {{1, {2, 3, 0}}};
  picture.tracks[1].kind = Kind::kRecordedRobot;
  picture.instant.emplace();
  EXPECT_FALSE(svg_of(picture).empty());
  EXPECT_FALSE(png_of(picture).empty());
}

TEST_F(PictureTest, AThousandRobotsLoseTheirLabelsAndNotTheirBodies) {
  Picture picture;
  picture.instant.emplace();
  for (int i = 0; i < 1000; ++i) {
    const auto row = i / 40;
    const Vec2 p_W = {static_cast<double>(i % 40), static_cast<double>(row)};
    picture.instant->robots.push_back(
        {square_W(p_W, 0.15), {p_W.x, p_W.y, 0}, Kind::kSimulatedRobot, "long label", ""});
    picture.tracks.push_back({"", Kind::kSimulatedRobot, "", {}, {}, false, {}});
    for (int k = 0; k < 20; ++k) {
      picture.tracks.back().points.push_back({1.0 * k, {p_W.x + 0.02 * k, p_W.y, 0}});
    }
  }
  const std::string svg = svg_of(picture);
  EXPECT_NE(svg.find("1000 simulated robots"), std::string::npos);
  EXPECT_LT(svg.size(), 4'000'000U);
  png_of(picture, 1);
  const Pixels pixels(folder_ / "a.png");
  const Panel panel = lay_out(picture).value().panels.back();
  EXPECT_NE(pixels.at(panel.to_page({0.05, 0.05})), 0xFFFFFFU);
  EXPECT_NE(pixels.at(panel.to_page({39.05, 24.05})), 0xFFFFFFU);
}

TEST_F(PictureTest, RefusesWhatCannotBeDrawn) {
  Picture picture = sample_picture();
  picture.tracks[3].points[2].X_WB.x = kNan;
  EXPECT_EQ(refusal_of(picture),
            "picture: a track point of `s1` is (nan, 1.03); expected finite metres within 1e7");
  picture = sample_picture();
  picture.tracks[3].points[2].t_s = 0.1;
  EXPECT_EQ(refusal_of(picture), "picture: track `s1` steps back from 0.5 s to 0.1 s");
  picture = sample_picture();
  picture.bodies[3].outline_W.resize(2);
  EXPECT_EQ(refusal_of(picture),
            "picture: the outline of `crate` has 2 corners; expected 3 or more");
  picture = sample_picture();
  picture.bodies[3].colour = "blue";
  EXPECT_EQ(refusal_of(picture), "picture: colour `blue` of `crate`: expected #rrggbb");
  picture = sample_picture();
  picture.instant->hits[1].to_W.y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of(picture),
            "picture: the end of `laser hit` is (3.5, inf); expected finite metres within 1e7");
  picture = sample_picture();
  picture.tick_s = 0;
  EXPECT_EQ(refusal_of(picture), "picture: tick_s is 0; expected more than 0 s");
  picture = sample_picture();
  picture.title = "\xff";
  EXPECT_EQ(refusal_of(picture), "picture: the title is not valid UTF-8");
  picture = sample_picture();
  picture.tracks[1].gaps = {{3, 2}};
  EXPECT_EQ(refusal_of(picture),
            "picture: pose gap of `robot 2` from 3 s to 2 s; expected finite, rising seconds");
}

TEST_F(PictureTest, RefusesBadPlacesAndScales) {
  const auto missing = write_svg(sample_picture(), folder_ / "no" / "a.svg");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_NE(missing.error().message.find("there is no folder"), std::string::npos);
  for (const double scale : {0.0, -1.0, 9.0, kNan}) {
    const auto status = write_png(sample_picture(), folder_ / "a.png", scale);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("expected 0.1 to 8"), std::string::npos);
  }
  std::filesystem::create_directories(folder_ / "a.png" / "occupied");
  EXPECT_EQ(write_png(sample_picture(), folder_ / "a.png").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace rave::report
