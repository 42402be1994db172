// SPDX-License-Identifier: Apache-2.0
#include "utias/subjects.hpp"

#include <algorithm>

#include "utias/samples.hpp"

namespace rave::utias {
namespace {

tl::unexpected<Error> refuse(const std::string& file, int line, std::string_view message) {
  return fail_at({file, line, 0}, ErrorCode::kParse, "{}", message);
}

int find_or(const std::map<int, int>& map, int key, int otherwise) noexcept {
  const auto found = map.find(key);
  return found == map.end() ? otherwise : found->second;
}

}  // namespace

// A barcode belongs to a subject, and a subject is a robot or a landmark. The data set has these
// facts in two files and the names of the logs. They are joined and checked here, because a wrong
// pair would let a camera see tubes at wrong places without any error.
Result<Subjects> Subjects::join(std::span<const LogRow> barcodes, const std::string& barcode_file,
                                std::span<const LogRow> landmarks, const std::string& landmark_file,
                                std::span<const int> robots) {
  Subjects subjects;
  RAVE_TRY(subjects.add_barcodes(barcodes, barcode_file));
  RAVE_TRY(subjects.add_landmarks(landmarks, landmark_file, barcode_file));
  for (const int robot : robots) {
    if (subjects.code_of_subject(robot) < 0) {
      return refuse(barcode_file, 0, fmt::format("robot {} has no row with its barcode", robot));
    }
  }
  // The other direction: a barcode of nothing that is known is an error of the file, not a subject
  // to be ignored.
  for (const LogRow& row : barcodes) {
    const int subject = row.codes[0];
    const bool is_landmark = std::any_of(subjects.landmarks_.begin(), subjects.landmarks_.end(),
                                         [&](const Landmark& l) { return l.subject == subject; });
    if (is_landmark || std::find(robots.begin(), robots.end(), subject) != robots.end()) continue;
    return refuse(
        barcode_file, row.line,
        fmt::format("subject {} is neither a robot with logs in this folder nor a landmark of {}",
                    subject, landmark_file));
  }
  return subjects;
}

Status Subjects::add_barcodes(std::span<const LogRow> rows, const std::string& file) {
  for (const LogRow& row : rows) {
    const auto [subject, code] = row.codes;
    // 0 stands for "belongs to nothing" in sightings.
    if (subject == kUnknownSubject) {
      return refuse(file, row.line, "subject numbers start at 1, found 0");
    }
    if (!code_by_subject_.emplace(subject, code).second) {
      return refuse(file, row.line, fmt::format("subject {} has two barcodes", subject));
    }
    const auto [owner, is_new] = subject_by_code_.emplace(code, subject);
    if (!is_new) {
      return refuse(
          file, row.line,
          fmt::format("barcode {} is given to subjects {} and {}", code, owner->second, subject));
    }
  }
  return {};
}

Status Subjects::add_landmarks(std::span<const LogRow> rows, const std::string& file,
                               const std::string& barcode_file) {
  for (const LogRow& row : rows) {
    const int subject = row.codes[0];
    const bool twice = std::any_of(landmarks_.begin(), landmarks_.end(),
                                   [&](const Landmark& l) { return l.subject == subject; });
    if (twice) return refuse(file, row.line, fmt::format("landmark {} is given twice", subject));
    const int code = code_of_subject(subject);
    if (code < 0) {
      return refuse(file, row.line,
                    fmt::format("landmark {} has no barcode in {}", subject, barcode_file));
    }
    landmarks_.push_back({subject, code, {row.reals[0], row.reals[1]}, row.reals[2], row.reals[3]});
  }
  return {};
}

int Subjects::subject_of_code(int code) const noexcept {
  return find_or(subject_by_code_, code, kUnknownSubject);
}

int Subjects::code_of_subject(int subject) const noexcept {
  return find_or(code_by_subject_, subject, -1);
}

}  // namespace rave::utias
