// SPDX-License-Identifier: Apache-2.0
// Real halves of hybrid sensors whose readings are known beforehand, and a program that writes down
// what it gets. Not installed.
#include <chrono>
#include <fstream>
#include <limits>
#include <thread>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kRangeParams[] = {
    integer_param("rays", 1, 1, 10000, "Number of rays, spread evenly."),
    number_param("fov_deg", "deg", 0, 0, 360, "Angle from the first ray to the last."),
    number_param("start_deg", "deg", 0, -360, 360, "Added to the direction of each ray."),
    number_param("cone_deg", "deg", 0, 0, 180, "Opening of a cone."),
    number_param("range_m", "m", 2, -1, 1000, "What each ray reads; above range_max_m: nothing."),
    number_param("range_min_m", "m", 0.15, 0, 1000, "Least range."),
    number_param("range_max_m", "m", 6, 0, 1000, "Largest range."),
    number_param("period_s", "s", 0.1, 1e-3, 10, "Between two stamps."),
    number_param("first_s", "s", 0, 0, 10, "The first stamp."),
};
constexpr ParamSpec kPoseParams[] = {
    number_param("x_m", "m", 0, -1e3, 1e3, "Where it stands."),
    number_param("y_m", "m", 0, -1e3, 1e3, "Where it stands."),
    number_param("yaw_deg", "deg", 0, -360, 360, "Where it looks at first."),
    number_param("turn_radps", "rad/s", 0, -10, 10, "How it turns."),
    number_param("sigma_xy_m", "m", 0.01, 0, 10, "What it states."),
    number_param("sigma_yaw_deg", "deg", 1, 0, 180, "What it states."),
    number_param("period_s", "s", 0.01, 1e-3, 10, "Between two stamps."),
};
constexpr ParamSpec kContactParams[] = {
    bool_param("touching", false, "What it says."),
};
constexpr ParamSpec kNoteParams[] = {
    text_param("file", "", "A line for each reading: wall ns, stamp ns, sequence, ranges in m."),
};

/// Publishes the same records at each stamp, as stepped drivers do, from its own thread.
template <class Record>
class Player : public HardwareSensor {
 public:
  ~Player() override { close(); }
  Status open(SampleSink& sink) override {
    thread_ = std::thread([this, &sink] {
      for (std::int64_t k = 0;; ++k) {
        const double t_s = first_s_ + period_s_ * static_cast<double>(k);
        const std::vector<Record> records = at(t_s);
        const SimTime stamp{from_seconds(t_s).ns};
        if (!sink.publish(stamp, records.data(), static_cast<std::uint32_t>(records.size())))
          return;
      }
    });
    return {};
  }
  void close() override {
    if (thread_.joinable()) thread_.join();
  }

 protected:
  [[nodiscard]] virtual std::vector<Record> at(double t_s) const = 0;
  double period_s_ = 0.1;
  double first_s_ = 0;

 private:
  std::thread thread_;
};

class StillRanges final : public Player<float> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;
  ~StillRanges() override { close(); }
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    const Params params = setup.parameters();
    const auto rays = static_cast<std::size_t>(params.integer("rays"));
    for (std::size_t i = 0; i < rays; ++i) {
      const double share =
          rays == 1 ? 0 : static_cast<double>(i) / static_cast<double>(rays - 1) - 0.5;
      bearings_rad_.push_back(
          deg_to_rad(params.number("start_deg") + share * params.number("fov_deg")));
    }
    const double range_m = params.number("range_m");
    ranges_m_.assign(rays, range_m > params.number("range_max_m")
                               ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(range_m));
    period_s_ = params.number("period_s");
    first_s_ = params.number("first_s");
    declaration.capacity = static_cast<std::uint32_t>(rays);
    declaration.bearings_rad = bearings_rad_.data();
    declaration.range_min_m = params.number("range_min_m");
    declaration.range_max_m = params.number("range_max_m");
    declaration.cone_rad = deg_to_rad(params.number("cone_deg"));
    return {};
  }

 private:
  [[nodiscard]] std::vector<float> at(double) const override { return ranges_m_; }
  std::vector<double> bearings_rad_;
  std::vector<float> ranges_m_;
};

class TurningPose final : public Player<PoseReading> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  ~TurningPose() override { close(); }
  Status configure(const HardwareSetup& setup, HardwareDeclaration&) override {
    const Params params = setup.parameters();
    const double sigma_m = params.number("sigma_xy_m");
    const double sigma_rad = deg_to_rad(params.number("sigma_yaw_deg"));
    pose_ = {params.number("x_m"), params.number("y_m"), deg_to_rad(params.number("yaw_deg")),
             sigma_m * sigma_m, sigma_rad * sigma_rad};
    turn_radps_ = params.number("turn_radps");
    period_s_ = params.number("period_s");
    return {};
  }

 private:
  [[nodiscard]] std::vector<PoseReading> at(double t_s) const override {
    PoseReading pose = pose_;
    pose.yaw_rad = wrap_angle(pose.yaw_rad + turn_radps_ * t_s);
    return {pose};
  }
  PoseReading pose_;
  double turn_radps_ = 0;
};

class StillContact final : public Player<ContactReading> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kContact;
  ~StillContact() override { close(); }
  Status configure(const HardwareSetup& setup, HardwareDeclaration&) override {
    touching_ = setup.parameters().flag("touching") ? 1 : 0;
    return {};
  }

 private:
  [[nodiscard]] std::vector<ContactReading> at(double) const override { return {{touching_, 0}}; }
  std::uint32_t touching_ = 0;
};

class Notebook final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(eye_, setup.sensor<float>());
    file_.open(std::string(setup.params().text("file")));
    return {};
  }
  void decide(const Percepts& percepts, Commands&) override {
    const SampleHeader& header = percepts.header(eye_);
    if (header.fresh == 0) return;
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    file_ << std::chrono::nanoseconds(now).count() << ' ' << header.stamp_ns << ' '
          << header.sequence;
    for (const float range_m : percepts[eye_]) file_ << ' ' << range_m;
    file_ << std::endl;  // a reader may look while the run goes on
  }

 private:
  RangesHandle eye_;
  std::ofstream file_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("still_ranges turning_pose still_contact notebook") {
  rave::add_sensor<rave::StillRanges>(
      registry,
      {.name = "still_ranges", .summary = "The same ranges.", .params = rave::kRangeParams});
  rave::add_sensor<rave::TurningPose>(
      registry, {.name = "turning_pose", .summary = "A pose.", .params = rave::kPoseParams});
  rave::add_sensor<rave::StillContact>(
      registry, {.name = "still_contact", .summary = "A bumper.", .params = rave::kContactParams});
  rave::add_program<rave::Notebook>(
      registry, {.name = "notebook", .summary = "Writes down.", .params = rave::kNoteParams});
}
