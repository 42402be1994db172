// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/interface.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

/// Passed to a hybrid sensor when it starts. One object serves all robots with the same driver and
/// parameters.
struct HybridSetup {
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  /// Properties of the two halves; of equal kind, and for ranges with equal rays.
  const SensorInfo* real = nullptr;
  const SensorInfo* imagined = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// The readings of both halves at one time, and the reading for the program. `imagined` was
/// evaluated at the stamp of `real`, for the robot's pose at that time.
struct FuseItem {
  const SampleHeader* real = nullptr;
  const void* real_records = nullptr;
  const SampleHeader* imagined = nullptr;
  const void* imagined_records = nullptr;
  SampleHeader* result = nullptr;  ///< The driver sets `count`; the engine sets the rest.
  void* result_records = nullptr;  ///< Room for the capacity of the real half.
};

/// Fuses the readings of a real and a virtual half into one. Noise, latency and filters of the
/// sensor are applied once, after fusion. Several threads may call fuse() at once for different
/// robots, so it is const.
class HybridSensor {
 public:
  virtual ~HybridSensor() = default;
  virtual Status start(const HybridSetup& setup) = 0;
  virtual void fuse(const FuseItem& item) const = 0;
};

/// The function table of a hybrid sensor, as the host calls it; made by add_hybrid_sensor().
struct HybridSensorOps {
  InstanceOps instance;
  int (*start)(void* instance, const HybridSetup* setup, ErrorText* error) = nullptr;
  /// Returns 0, or 1 with `error` set.
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
    return guarded(error, [&] { static_cast<const T*>(instance)->T::fuse(*item); });
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
