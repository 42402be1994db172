// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "utias/text_log.hpp"

namespace rave::utias {

/// A tube with a barcode. Position of its centre in the frame W of the motion capture, metres.
struct Landmark {
  int subject = 0;
  int code = 0;
  Vec2 p_WL;
  /// Standard deviations of the survey.
  double x_std_m = 0;
  double y_std_m = 0;
};

/// The subjects (robots and landmarks) and their barcodes.
class Subjects {
 public:
  /// Joins the rows of `Barcodes.dat` and `Landmark_Groundtruth.dat`; the file names are used in
  /// messages. Errors (kParse): a duplicate subject or barcode, a landmark or a robot of `robots`
  /// without a barcode, a barcode of an unknown subject.
  [[nodiscard]] static Result<Subjects> join(std::span<const LogRow> barcodes,
                                             const std::string& barcode_file,
                                             std::span<const LogRow> landmarks,
                                             const std::string& landmark_file,
                                             std::span<const int> robots);

  [[nodiscard]] std::span<const Landmark> landmarks() const noexcept { return landmarks_; }
  /// The subject with a barcode, or kUnknownSubject.
  [[nodiscard]] int subject_of_code(int code) const noexcept;
  /// The barcode of a subject, or -1.
  [[nodiscard]] int code_of_subject(int subject) const noexcept;

 private:
  Status add_barcodes(std::span<const LogRow> rows, const std::string& file);
  Status add_landmarks(std::span<const LogRow> rows, const std::string& file,
                       const std::string& barcode_file);

  std::vector<Landmark> landmarks_;
  std::map<int, int> subject_by_code_;
  std::map<int, int> code_by_subject_;
};

}  // namespace rave::utias
