// SPDX-License-Identifier: Apache-2.0
#include "setup_copy.hpp"

#include <concepts>
#include <cstring>
#include <span>
#include <type_traits>

namespace rave::isolation {
namespace {

// The members of a struct that Writer and SetupCopy::Reader handle alike, in one list for both. S
// is constant for the writer.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

void members(auto& archive, Is<RobotInfo> auto& info) {
  archive.text(info.name);
  archive.text(info.team);
  archive.values(info.id, info.radius_m, info.seed);
}

void members(auto& archive, Is<SensorInfo> auto& info) {
  archive.text(info.name);
  archive.values(info.kind, info.capacity, info.X_RS, info.z_m, info.period_s, info.max_age_s,
                 info.range_min_m, info.range_max_m, info.cone_rad);
}

void members(auto& archive, Is<ControllerInfo> auto& info) {
  archive.text(info.name);
  archive.values(info.accepts);
}

void members(auto& archive, Is<CommunicatorInfo> auto& info) {
  archive.text(info.name);
  archive.values(info.max_messages, info.max_bytes, info.max_message_bytes);
}

// The bytes have the layout of this machine and this build. ProgramHost::create() checks magic and
// sizes, in case the runner is of another installation.
class Writer {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void values(const auto&... all) { (value(all), ...); }
  void text(std::string_view text) {
    value(std::uint64_t{text.size()});
    bytes_.append(text);
  }
  void list(std::span<const double> list) {
    value(std::uint64_t{list.size()});
    for (const double number : list) value(number);
  }
  void sensor(const SensorInfo& info) {
    members(*this, info);
    value(std::uint8_t{info.bearings_rad != nullptr});
    if (info.bearings_rad != nullptr) list({info.bearings_rad, info.capacity});
  }
  void param(const ParamValue& param) {
    text(param.name);
    value(param.number);
    text(param.text == nullptr ? "" : param.text);
    list({param.list, param.list_size});
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace

std::string encode_setup(const Order& order, const ProgramSetup& setup) {
  Writer out;
  out.text(order.plugin);
  out.text(order.program);
  out.value(order.parent);
  members(out, setup.robot);
  out.value(setup.period_s);
  out.value(setup.sensor_count);
  for (std::uint64_t i = 0; i < setup.sensor_count; ++i) out.sensor(setup.sensors[i]);
  out.value(setup.controller_count);
  for (std::uint64_t i = 0; i < setup.controller_count; ++i) members(out, setup.controllers[i]);
  out.value(setup.communicator_count);
  for (std::uint64_t i = 0; i < setup.communicator_count; ++i) members(out, setup.communicators[i]);
  out.value(setup.robot_count);
  for (std::uint64_t i = 0; i < setup.robot_count; ++i) out.text(setup.robot_names[i]);
  out.value(setup.param_count);
  for (std::uint64_t i = 0; i < setup.param_count; ++i) out.param(setup.params[i]);
  return out.take();
}

std::string encode_update(std::span<const ParamValue> params, double radius_m) {
  Writer out;
  out.value(radius_m);
  out.value(std::uint64_t{params.size()});
  for (const ParamValue& param : params) out.param(param);
  return out.take();
}

/// Reads in the order of Writer; after the first value that is missing or invalid, all further
/// values are empty.
class SetupCopy::Reader {
 public:
  Reader(std::string_view bytes, SetupCopy& copy) : bytes_(bytes), copy_(copy) {}

  template <class T>
  void value(T& value) {
    if (bytes_.size() < sizeof value) return fail_here();
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
  }
  /// Reads the number of elements that follow; refuses a number for which, at `least_bytes` each,
  /// too few bytes are left.
  /// A count from damaged bytes cannot make the child allocate more than the bytes could describe.
  std::size_t count(std::size_t least_bytes) {
    std::uint64_t number = 0;
    value(number);
    if (number <= bytes_.size() / least_bytes) return number;
    fail_here();
    return 0;
  }
  std::string_view text() {
    const std::size_t size = count(1);
    const std::string_view text = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return text;
  }
  // A deque keeps its elements where they are, so the pointers stay valid while more are added.
  void text(const char*& kept) { kept = copy_.texts_.emplace_back(text()).c_str(); }
  void values(auto&... all) { (value(all), ...); }
  std::span<const double> list() {
    std::vector<double>& list = copy_.lists_.emplace_back(count(sizeof(double)));
    for (double& number : list) value(number);
    return list;
  }
  void sensor(SensorInfo& info) {
    members(*this, info);
    std::uint8_t has_bearings = 0;
    value(has_bearings);
    if (has_bearings == 0) return;
    const std::span<const double> bearings = list();
    if (bearings.size() != info.capacity) fail_here();
    info.bearings_rad = bearings.data();
  }
  void param(ParamValue& param) {
    text(param.name);
    value(param.number);
    text(param.text);
    const std::span<const double> numbers = list();
    param.list = numbers.data();
    param.list_size = numbers.size();
  }
  [[nodiscard]] bool whole() const { return ok_ && bytes_.empty(); }

 private:
  void fail_here() {
    ok_ = false;
    bytes_ = {};
  }
  std::string_view bytes_;
  SetupCopy& copy_;
  bool ok_ = true;
};

Result<std::unique_ptr<SetupCopy>> SetupCopy::decode(std::string_view bytes) {
  std::unique_ptr<SetupCopy> copy(new SetupCopy);
  ProgramSetup& setup = copy->setup_;
  Reader in(bytes, *copy);
  copy->order_.plugin = in.text();
  copy->order_.program = in.text();
  in.value(copy->order_.parent);
  members(in, setup.robot);
  in.value(setup.period_s);
  copy->sensors_.resize(in.count(sizeof(std::uint64_t)));
  for (SensorInfo& info : copy->sensors_) in.sensor(info);
  copy->controllers_.resize(in.count(sizeof(std::uint64_t)));
  for (ControllerInfo& info : copy->controllers_) members(in, info);
  copy->communicators_.resize(in.count(sizeof(std::uint64_t)));
  for (CommunicatorInfo& info : copy->communicators_) members(in, info);
  copy->robot_names_.resize(in.count(sizeof(std::uint64_t)));
  for (const char*& name : copy->robot_names_) in.text(name);
  copy->params_.resize(in.count(sizeof(std::uint64_t)));
  for (ParamValue& value : copy->params_) in.param(value);
  if (!in.whole()) return fail(ErrorCode::kParse, "the setup of an isolated program is damaged");
  setup.sensors = copy->sensors_.data();
  setup.sensor_count = copy->sensors_.size();
  setup.controllers = copy->controllers_.data();
  setup.controller_count = copy->controllers_.size();
  setup.communicators = copy->communicators_.data();
  setup.communicator_count = copy->communicators_.size();
  setup.robot_names = copy->robot_names_.data();
  setup.robot_count = copy->robot_names_.size();
  setup.params = copy->params_.data();
  setup.param_count = copy->params_.size();
  return copy;
}

Status SetupCopy::update(std::string_view bytes) {
  Reader in(bytes, *this);
  double radius_m = 0;
  in.value(radius_m);
  std::vector<ParamValue> params(in.count(sizeof(std::uint64_t)));
  for (ParamValue& value : params) in.param(value);
  if (!in.whole()) return fail(ErrorCode::kParse, "new parameters of a program are damaged");
  // For revert(), if the program refuses the new values.
  params_before_ = params_;
  radius_before_m_ = setup_.robot.radius_m;
  use(std::move(params), radius_m);
  return {};
}

void SetupCopy::revert() { use(std::move(params_before_), radius_before_m_); }

void SetupCopy::use(std::vector<ParamValue> params, double radius_m) {
  params_ = std::move(params);
  setup_.params = params_.data();
  setup_.param_count = params_.size();
  setup_.robot.radius_m = radius_m;
}

}  // namespace rave::isolation
