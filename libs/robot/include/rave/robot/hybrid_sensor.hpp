// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/interface.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

/// What a hybrid sensor is given when it starts. One object serves all robots that use the driver
/// with the same parameters.
struct HybridSetup {
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  /// What the two halves declare; of one kind, and for ranges with the same rays.
  const SensorInfo* real = nullptr;
  const SensorInfo* imagined = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// The two readings of one instant, and where the one reading of the program goes. `imagined` was
/// evaluated at the stamp of `real` and at the pose that the robot had then.
struct FuseItem {
  const SampleHeader* real = nullptr;
  const void* real_records = nullptr;
  const SampleHeader* imagined = nullptr;
  const void* imagined_records = nullptr;
  SampleHeader* result = nullptr;  ///< The driver sets `count`; the engine sets the rest.
  void* result_records = nullptr;  ///< Room for the capacity of the real half.
};

/// A sensor with a real and a virtual half: makes one reading of the two. Processing (noise,
/// latency, filters of the sensor) comes once, after that. fuse() may run in several threads at
/// once for different robots, so it is const.
class HybridSensor {
 public:
  virtual ~HybridSensor() = default;
  virtual Status start(const HybridSetup& setup) = 0;
  virtual void fuse(const FuseItem& item) const = 0;
};

/// The functions of a rule of fusion as the host calls them; made by add_hybrid_sensor().
struct HybridSensorOps {
  InstanceOps instance;
  int (*start)(void* instance, const HybridSetup* setup, ErrorText* error) = nullptr;
  /// 0, or 1 with `error` set.
  int (*fuse)(const void* instance, const FuseItem* item, ErrorText* error) = nullptr;
};

namespace detail {
template <class T>
constexpr HybridSensorOps hybrid_sensor_ops() noexcept {
  HybridSensorOps ops;
  ops.instance = instance_ops<T>();
  ops.start = [](void* instance, const HybridSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->start(*setup); });
  };
  ops.fuse = [](const void* instance, const FuseItem* item, ErrorText* error) {
    return guarded(error, [&]() -> Status {
      static_cast<const T*>(instance)->T::fuse(*item);
      return {};
    });
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
