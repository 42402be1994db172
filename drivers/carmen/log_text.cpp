// SPDX-License-Identifier: Apache-2.0
#include "carmen/log_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "rave/base/names.hpp"
#include "recording/line_parser.hpp"
#include "recording/stamp.hpp"

namespace rave::carmen {
namespace {

using recording::add_repair;
using recording::parse_number;
using recording::parse_stamp_ns;
using recording::RepairKind;
using recording::shown;

constexpr double kLargestReal = 1e6;
constexpr double kLongestRange_m = 1000;
constexpr std::uint32_t kMostBeams = 100'000;
// Corrected logs are full of ODOM rows with an invalid stamp right behind a scan. One second
// separates them from rows that are merely out of order.
constexpr std::int64_t kJunkLimit_ns = 1'000'000'000;
/// The words after the content of every message: ipc_timestamp, ipc_hostname, logger_timestamp.
constexpr std::size_t kTail = 3;

constexpr std::array<std::string_view, 20> kMessages{
    "FLASER",    "ODOM",      "PARAM",       "SYNC",        "RLASER",    "TRUEPOS",   "NEFF",
    "LASER3",    "LASER4",    "ROBOTLASER1", "ROBOTLASER2", "RAWLASER1", "RAWLASER2", "RAWLASER3",
    "RAWLASER4", "RAWLASER5", "BASEODOM",    "SIM_TRUE",    "NMEAGGA",   "NMEARMC"};

class LogParser final : recording::LineParser {
 public:
  LogParser(const std::string& file, bool accept_cut) : LineParser(file, accept_cut) {}

  Result<ParsedLog> parse(const recording::UnpackedText& log) {
    RAVE_TRY(parse_lines(log));
    return std::move(log_);
  }

 private:
  Status take_line() override {
    const std::string_view name = words_.front().text;
    // Only the row right behind a scan can be such a leftover, so the flag holds for one line.
    const bool behind_scan = behind_scan_;
    behind_scan_ = false;
    if (name == "FLASER") return take_scan();
    if (name == "ODOM") return take_odometry(behind_scan);
    if (std::find(kMessages.begin(), kMessages.end(), name) == kMessages.end()) {
      return refuse(0, fmt::format("`{}` is not a message of a CARMEN log{}", shown(name),
                                   suggestion(name, kMessages)));
    }
    ++log_.passed_over;
    return {};
  }

  /// FLASER n r1 … rn x y theta odom_x odom_y odom_theta.
  Status take_scan() {
    RAVE_TRY_ASSIGN(const std::uint32_t beams, beams_of_line());
    // The number of words follows from the number of ranges, so a line that lost a word is noticed.
    RAVE_TRY(expect_words(2 + beams + 6 + kTail));
    ScanRow row;
    row.line = line_;
    RAVE_TRY_ASSIGN(row.stamp_ns, stamp());
    row.logged_ns = parse_stamp_ns(words_.back().text);
    row.first = log_.ranges_m.size();
    for (std::size_t i = 2; i < 2 + beams; ++i) {
      RAVE_TRY_ASSIGN(const double range_m, number(i, "range [m]", 0, kLongestRange_m));
      log_.ranges_m.push_back(static_cast<float>(range_m));
    }
    RAVE_TRY_ASSIGN(row.X_WL, pose(2 + beams));
    RAVE_TRY(pose(5 + beams));  // of odometry; equal in a corrected log
    log_.beams = beams;
    log_.scans.push_back(row);
    behind_scan_ = true;
    return {};
  }

  Result<std::uint32_t> beams_of_line() {
    if (words_.size() < 2) return refuse_count("the number of ranges");
    const auto beams = parse_number<std::uint32_t>(words_[1].text);
    if (!beams || *beams == 0 || *beams > kMostBeams) {
      return refuse(1, fmt::format("the number of ranges is `{}`: expected 1 to {}",
                                   shown(words_[1].text), kMostBeams));
    }
    // One sensor has one set of bearings; the log of two lasers under one name cannot be played.
    if (!log_.scans.empty() && *beams != log_.beams) {
      return refuse(
          1, fmt::format("this scan has {} ranges, the scans before it {}", *beams, log_.beams));
    }
    return *beams;
  }

  /// ODOM x y theta tv rv accel.
  Status take_odometry(bool behind_scan) {
    RAVE_TRY(expect_words(1 + 6 + kTail));
    OdometryRow row;
    row.line = line_;
    RAVE_TRY_ASSIGN(row.X_WR, pose(1));
    RAVE_TRY_ASSIGN(row.v_mps, number(4, "tv [m/s]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(row.w_radps, number(5, "rv [rad/s]", -kLargestReal, kLargestReal));
    if (behind_scan && is_junk()) {
      add_repair(log_.odometry_repairs, RepairKind::kJunkStamp, 1, line_);
      return {};
    }
    RAVE_TRY_ASSIGN(row.stamp_ns, stamp());
    row.logged_ns = parse_stamp_ns(words_.back().text);
    log_.odometry.push_back(row);
    return {};
  }

  /// Whether the stamp of this row is invalid, given the stamp of the scan before it.
  [[nodiscard]] bool is_junk() const {
    const std::string_view text = words_[words_.size() - kTail].text;
    const auto stamp_ns = parse_stamp_ns(text);
    if (!stamp_ns) return parse_number<double>(text).has_value();
    return *stamp_ns < log_.scans.back().stamp_ns - kJunkLimit_ns;
  }

  Result<std::int64_t> stamp() {
    const std::size_t at = words_.size() - kTail;
    const auto stamp_ns = parse_stamp_ns(words_[at].text);
    if (stamp_ns) return *stamp_ns;
    return refuse(at, fmt::format("ipc_timestamp is `{}`: expected seconds with at most nine "
                                  "decimals",
                                  shown(words_[at].text)));
  }

  Result<Pose2> pose(std::size_t at) {
    Pose2 pose;
    RAVE_TRY_ASSIGN(pose.x, number(at, "x [m]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(pose.y, number(at + 1, "y [m]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(pose.yaw, number(at + 2, "theta [rad]", -1e4, 1e4));
    return pose;
  }

  Result<double> number(std::size_t at, std::string_view name, double least, double most) {
    const auto value = parse_number<double>(words_[at].text);
    if (value && *value >= least && *value <= most) return *value;
    return refuse(at, fmt::format("{} is `{}`: expected a number from {:g} to {:g}", name,
                                  shown(words_[at].text), least, most));
  }

  Status expect_words(std::size_t count) {
    if (words_.size() == count) return {};
    return refuse_count(fmt::format("{} words", count));
  }

  tl::unexpected<Error> refuse_count(std::string_view expected) {
    return fail_at({file_, line_, static_cast<int>(line_text_.size()) + 1}, ErrorCode::kParse,
                   "{}: expected {}, found {} words", shown(words_.front().text), expected,
                   words_.size());
  }

  tl::unexpected<Error> refuse(std::size_t word, std::string_view message) {
    return fail_at({file_, line_, words_[word].column}, ErrorCode::kParse, "{}", message);
  }

  std::string whole() const override { return fmt::format("{} whole scans", log_.scans.size()); }
  std::vector<recording::Repair>& cut_repairs() override { return log_.scan_repairs; }

  ParsedLog log_;
  bool behind_scan_ = false;
};

}  // namespace

Result<ParsedLog> parse_log(const recording::UnpackedText& log, const std::string& file,
                            bool accept_cut) {
  return LogParser(file, accept_cut).parse(log);
}

}  // namespace rave::carmen
