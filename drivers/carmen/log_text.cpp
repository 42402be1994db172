// SPDX-License-Identifier: Apache-2.0
#include "carmen/log_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

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
constexpr double kLargestAngle_rad = 1e4;
constexpr double kWholeTurn = 6.3;
constexpr std::uint32_t kMostBeams = 100'000;
// Corrected logs are full of ODOM rows with an invalid stamp right behind a scan. One second
// separates them from rows that are merely out of order.
constexpr std::int64_t kJunkLimit_ns = 1'000'000'000;
/// The words after the content of every message: ipc_timestamp, ipc_hostname, logger_timestamp.
constexpr std::size_t kTail = 3;
constexpr std::size_t kPoseWords = 3;
/// tv, rv, two safety distances and turn_axis of a ROBOTLASER message.
constexpr std::size_t kMotionWords = 5;
/// A file that is no log has a new name in every line.
constexpr std::size_t kMostKinds = 24;
constexpr std::size_t kMostRefusals = 3;

class LogParser final : recording::LineParser {
 public:
  LogParser(const std::string& file, bool accept_cut, LaserSide side)
      : LineParser(file, accept_cut), side_(side) {}

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
    const ScanMessage* message = scan_message(name);
    if (message != nullptr && message->side == side_) {
      const std::size_t held = log_.ranges_m.size();
      const Status taken = take_scan(*message);
      behind_scan_ = taken.has_value();
      if (taken) return {};
      log_.ranges_m.resize(held);
      log_.refuse(log_.scan_repairs, line_, taken.error().text());
    } else if (name == "ODOM") {
      const Status taken = take_odometry(behind_scan);
      if (!taken) log_.refuse(log_.odometry_repairs, line_, taken.error().text());
    } else {
      if (name == "PARAM") take_parameter();
      log_.pass_over(shown(name), std::ranges::find(kKnownMessages, name) != kKnownMessages.end());
    }
    return {};
  }

  /// The messages are described at ScanLayout.
  Status take_scan(const ScanMessage& message) {
    ScanRow row;
    row.line = line_;
    row.message = &message;
    std::size_t at = 1;
    if (message.layout != ScanLayout::kOld) {
      RAVE_TRY(take_configuration(row));
      at = 8;
    }
    RAVE_TRY_ASSIGN(row.beams, count(at, 1, "the number of ranges"));
    const std::size_t first_range = at + 1;
    at = first_range + row.beams;
    if (message.layout != ScanLayout::kOld) {
      RAVE_TRY_ASSIGN(const std::uint32_t remissions, count(at, 0, "the number of remissions"));
      at += 1 + remissions;
    }
    const std::size_t pose_at = at;
    if (message.layout != ScanLayout::kRaw) at += 2 * kPoseWords;
    if (message.layout == ScanLayout::kRobot) at += kMotionWords;
    // The number of words follows from the number of ranges, so a line that lost a word is noticed.
    RAVE_TRY(expect_words(at + kTail));
    row.stamps = stamps();
    RAVE_TRY(take_ranges(row, first_range));
    if (message.layout != ScanLayout::kRaw) {
      RAVE_TRY_ASSIGN(row.X_WL, pose(pose_at));
    }
    log_.scans.push_back(row);
    return {};
  }

  /// laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode.
  Status take_configuration(ScanRow& row) {
    if (words_.size() < 9) return refuse_count("the configuration of a laser");
    RAVE_TRY_ASSIGN(row.start_rad, number(2, "start_angle [rad]", -kWholeTurn, kWholeTurn));
    RAVE_TRY_ASSIGN(row.step_rad, number(4, "angular_resolution [rad]", 0, kWholeTurn));
    RAVE_TRY_ASSIGN(row.maximum_m, number(5, "maximum_range [m]", 0, kLargestReal));
    return {};
  }

  Status take_ranges(ScanRow& row, std::size_t at) {
    row.first = log_.ranges_m.size();
    for (std::size_t i = at; i < at + row.beams; ++i) {
      const auto range_m = parse_number<double>(words_[i].text);
      if (!range_m) {
        return refuse(i,
                      fmt::format("range [m] is `{}`: expected a number", shown(words_[i].text)));
      }
      // Devices write NaN or a negative number for what they could not measure.
      const bool measured = *range_m >= 0;
      constexpr double kMost = std::numeric_limits<float>::max();
      log_.ranges_m.push_back(measured ? static_cast<float>(std::min(*range_m, kMost))
                                       : std::numeric_limits<float>::quiet_NaN());
    }
    return {};
  }

  Result<std::uint32_t> count(std::size_t at, std::uint32_t least, std::string_view what) {
    if (words_.size() <= at) return refuse_count(what);
    const auto count = parse_number<std::uint32_t>(words_[at].text);
    if (count && *count >= least && *count <= kMostBeams) return *count;
    return refuse(at, fmt::format("{} is `{}`: expected {} to {}", what, shown(words_[at].text),
                                  least, kMostBeams));
  }

  /// PARAM name value; where the laser is on the robot.
  void take_parameter() {
    const std::string_view name =
        side_ == LaserSide::kFront ? "robot_frontlaser_offset" : "robot_rearlaser_offset";
    if (words_.size() < 3 || words_[1].text != name) return;
    const auto offset_m = parse_number<double>(words_[2].text);
    if (offset_m && std::abs(*offset_m) <= kLargestReal) log_.laser_offset_m = *offset_m;
  }

  /// ODOM x y theta tv rv accel.
  Status take_odometry(bool behind_scan) {
    RAVE_TRY(expect_words(1 + 6 + kTail));
    OdometryRow row;
    row.line = line_;
    RAVE_TRY_ASSIGN(row.X_WR, pose(1));
    RAVE_TRY_ASSIGN(row.v_mps, number(4, "tv [m/s]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(row.w_radps, number(5, "rv [rad/s]", -kLargestReal, kLargestReal));
    row.stamps = stamps();
    if (behind_scan && is_junk(row)) {
      add_repair(log_.odometry_repairs, RepairKind::kJunkStamp, 1, line_);
      return {};
    }
    log_.odometry.push_back(row);
    return {};
  }

  /// Whether the stamp of this row is invalid, given the stamp of the scan before it.
  [[nodiscard]] bool is_junk(const OdometryRow& row) const {
    const std::optional<std::int64_t> scan_ns = log_.scans.back().stamps.message_ns;
    if (!scan_ns) return false;
    return !row.stamps.message_ns || *row.stamps.message_ns < *scan_ns - kJunkLimit_ns;
  }

  [[nodiscard]] RowStamps stamps() const {
    return {parse_stamp_ns(words_[words_.size() - kTail].text), parse_stamp_ns(words_.back().text)};
  }

  Result<Pose2> pose(std::size_t at) {
    Pose2 pose;
    RAVE_TRY_ASSIGN(pose.x, number(at, "x [m]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(pose.y, number(at + 1, "y [m]", -kLargestReal, kLargestReal));
    RAVE_TRY_ASSIGN(pose.yaw, number(at + 2, "theta [rad]", -kLargestAngle_rad, kLargestAngle_rad));
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

  LaserSide side_;
  ParsedLog log_;
  bool behind_scan_ = false;
};

}  // namespace

void ParsedLog::pass_over(std::string_view name, bool known) {
  if (passed_over.size() == kMostKinds &&
      std::ranges::find(passed_over, name, &PassedOver::name) == passed_over.end()) {
    passed_over.push_back({"others", 0, false});
  }
  if (passed_over.size() > kMostKinds &&
      std::ranges::find(passed_over, name, &PassedOver::name) == passed_over.end()) {
    name = passed_over.back().name;
  }
  auto kind = std::ranges::find(passed_over, name, &PassedOver::name);
  if (kind == passed_over.end()) {
    kind = passed_over.insert(kind, {std::string(name), 0, known});
  }
  ++kind->count;
}

void ParsedLog::refuse(std::vector<recording::Repair>& repairs, int line, std::string why) {
  add_repair(repairs, RepairKind::kRefusedRow, 1, line);
  if (refusals.size() < kMostRefusals) refusals.push_back(std::move(why));
}

Result<ParsedLog> parse_log(const recording::UnpackedText& log, const std::string& file,
                            bool accept_cut, LaserSide side) {
  return LogParser(file, accept_cut, side).parse(log);
}

}  // namespace rave::carmen
