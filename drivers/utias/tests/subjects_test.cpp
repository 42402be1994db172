// SPDX-License-Identifier: Apache-2.0
#include "temporary_dataset.hpp"

namespace rave::utias {
namespace {

using SubjectsTest = TemporaryDataset;

TEST_F(SubjectsTest, JoinsBarcodesAndLandmarks) {
  const auto data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  EXPECT_EQ(data->subjects.subject_of_code(14), 2);
  EXPECT_EQ(data->subjects.subject_of_code(7), kUnknownSubject);
  EXPECT_EQ(data->subjects.code_of_subject(6), 63);
  EXPECT_EQ(data->subjects.code_of_subject(7), -1);
  ASSERT_EQ(data->subjects.landmarks().size(), 1U);
  EXPECT_EQ(data->subjects.landmarks()[0].code, 63);
  EXPECT_EQ(data->subjects.landmarks()[0].p_WL, (Vec2{0.5, -4.25}));
  EXPECT_EQ(data->subjects.landmarks()[0].y_std_m, 0.0002);
}

TEST_F(SubjectsTest, RefusesTablesThatContradictThemselves) {
  const std::string file = in_folder("Barcodes.dat");
  put("Barcodes.dat", "1 5\n2 14\n1 63\n");
  EXPECT_EQ(error(), file + ":3: subject 1 has two barcodes");
  put("Barcodes.dat", "1 5\n2 14\n6 5\n");
  EXPECT_EQ(error(), file + ":3: barcode 5 is given to subjects 1 and 6");
  put("Barcodes.dat", "0 5\n");
  EXPECT_EQ(error(), file + ":1: subject numbers start at 1, found 0");
  put("Barcodes.dat", "1 5\n2 fourteen\n");
  EXPECT_EQ(error(), file +
                         ":2:3: barcode is `fourteen`: expected a whole number from 0 to "
                         "1000000");
}

TEST_F(SubjectsTest, RefusesRowsThatBelongToNobody) {
  const std::string barcodes = in_folder("Barcodes.dat");
  const std::string landmarks = in_folder("Landmark_Groundtruth.dat");
  put("Barcodes.dat", "1 5\n2 14\n6 63\n21 90\n");
  EXPECT_EQ(error(),
            barcodes +
                ":4: subject 21 is neither a robot with logs in this folder nor a landmark of " +
                landmarks);
  put("Barcodes.dat", "1 5\n6 63\n");
  EXPECT_EQ(error(), barcodes + ": robot 2 has no row with its barcode");
  put("Barcodes.dat", "1 5\n2 14\n");
  EXPECT_EQ(error(), landmarks + ":1: landmark 6 has no barcode in " + barcodes);
  put("Barcodes.dat", "1 5\n2 14\n6 63\n");
  put("Landmark_Groundtruth.dat", "6 0 0 0 0\n6 1 1 0 0\n");
  EXPECT_EQ(error(), landmarks + ":2: landmark 6 is given twice");
}

}  // namespace
}  // namespace rave::utias
