// SPDX-License-Identifier: Apache-2.0
// What is refused of tiles of maps.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace rave::bus::testing {
namespace {

/// The upper right tile of a map of 70 x 66 cells: 6 x 2 cells.
class ValidateMap : public ::testing::Test {
 protected:
  ValidateMap() {
    tile_.writer = 1;
    put_text(tile_.source, "walker-1");
    tile_.resolution_m = 0.1;
    tile_.columns = 70;
    tile_.rows = 66;
    tile_.column = tile_.row = 1;
    tile_.revision = 1;
    borrow(tile_.cells, cells_);
  }
  [[nodiscard]] std::string judged() const {
    const Status status = validate(tile_);
    return status ? "accepted" : status.error().message;
  }

  std::vector<std::uint8_t> cells_ = std::vector<std::uint8_t>(12, rave_wire_kCellUnknown);
  MapTile tile_{};
};

TEST_F(ValidateMap, ATileHasTheCellsOfItsPlace) {
  EXPECT_EQ(judged(), "accepted");
  tile_.column = 0;
  EXPECT_EQ(judged(), "cells has 12 entries for a tile of 64 x 2");
  tile_.column = 2;
  EXPECT_EQ(judged(), "a map of 70 x 66 cells has no tile (2, 1)");
  tile_.column = 0xffffffff;
  EXPECT_EQ(judged(), "a map of 70 x 66 cells has no tile (4294967295, 1)");
}

TEST_F(ValidateMap, NoStartOfATileIsTakenForAWhole) {
  const auto bytes = encode(tile_);
  Decoded<MapTile> whole;
  ASSERT_TRUE(whole.decode(bytes));
  EXPECT_TRUE(validate(whole.sample()));
  EXPECT_STREQ(whole.sample().source, "walker-1");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Decoded<MapTile> cut;
    EXPECT_FALSE(cut.decode(std::span(bytes).first(size))) << size;
  }
}

TEST_F(ValidateMap, CellsArePercentOrUnknown) {
  cells_[3] = 100;
  EXPECT_EQ(judged(), "accepted");
  cells_[3] = 101;
  EXPECT_EQ(judged(), "cells[3] is 101; expected 0 to 100, or 255");
}

TEST_F(ValidateMap, AFrameIsFinite) {
  tile_.resolution_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(), "resolution_m is nan, not within 0.001 to 1000");
  tile_.resolution_m = 0.1;
  tile_.origin_y_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judged().substr(0, 17), "origin_y_m is inf");
  tile_.origin_y_m = 0;
  tile_.columns = 1 << 20;
  EXPECT_EQ(judged(), "the map has 1048576 x 66 cells; expected 1 to 16384 along each side");
}

TEST_F(ValidateMap, ATileSaysWhoseItIs) {
  put_text(tile_.source, "");
  EXPECT_EQ(judged(), "source is empty");
  put_text(tile_.source, "two\nlines");
  EXPECT_EQ(judged(), "source has control characters");
  put_text(tile_.source, "walker-1");
  tile_.revision = 0;
  EXPECT_EQ(judged(), "revision is 0");
}

}  // namespace
}  // namespace rave::bus::testing
