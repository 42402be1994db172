// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "rave/base/random.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/world/world_view.hpp"

namespace rave {

/// What a virtual sensor leaves to the engine. A sensor that declares a fan writes no loop of its
/// own: the engine casts the rays of all robots in one batch.
struct FanQuery {
  /// Directions in the sensor frame, `ray_count` of them; they live as long as the instance.
  const double* bearings_rad = nullptr;
  std::uint32_t ray_count = 0;
  /// Each reading is the smallest of this many neighbouring rays: 1 for a laser, more for a cone.
  std::uint32_t rays_per_reading = 1;
  double range_min_m = 0;  ///< Nearer is read as range_min_m.
  double range_max_m = 0;  ///< Farther is no return: +infinity.
};

/// What a virtual sensor says of itself once it knows its parameters.
struct VirtualDeclaration {
  std::uint32_t capacity = 1;  ///< Records at most; ignored with a fan (one per reading).
  std::uint32_t uses_fan = 0;  ///< 1: `fan` is filled and sample() is never called.
  FanQuery fan;
  double cone_rad = 0;  ///< Opening of a cone, for SensorInfo.
  /// For SensorInfo of ranges with a cone: directions of the readings; null: those of the fan.
  const double* reading_bearings_rad = nullptr;
};

/// What a virtual sensor is given when it is configured. One object serves all robots that use the
/// driver with the same parameters.
struct VirtualSensorSetup {
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  LayerMask layers = kAllLayers;  ///< What the robot file lets the sensor see.
  std::uint32_t reserved = 0;
  double period_s = 0;
  double z_m = 0;  ///< Mounting height.
  /// The real half whose virtual half this is; null if the sensor is not hybrid. Valid during
  /// configure().
  const SensorInfo* real_half = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// One sample of one robot: where to look from and where to write.
struct SampleItem {
  RobotId robot;
  std::uint32_t device = 0;
  std::uint64_t seed = 0;
  std::uint32_t sequence = 0;  ///< Number of this sample, from 0.
  std::uint32_t capacity = 0;
  Pose2 X_WR;  ///< Of the robot.
  Pose2 X_WS;  ///< Of the sensor.
  double z_m = 0;
  double elapsed_s = 0;  ///< Since the last sample of this sensor (its period; 0 at first).
  SampleHeader* header = nullptr;  ///< The driver sets `count`; the engine sets the rest.
  void* records = nullptr;         ///< Room for `capacity` records.
  /// `state_size` bytes that belong to this sensor of this robot, zero at the start and after a
  /// reset.
  void* state = nullptr;

  /// Random numbers of this sample. Noise configured in the robot file draws elsewhere.
  [[nodiscard]] RandomStream random() const noexcept {
    return {seed, robot.value(), device, sequence};
  }
};

/// A sensor of the virtual world. configure() comes once; sample() may run in several threads at
/// once for different robots, so it is const: what changes lives in SampleItem::state.
class VirtualSensor {
 public:
  virtual ~VirtualSensor() = default;
  virtual Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) = 0;
  /// Fills the records of one robot. Not called for a sensor that declares a fan.
  virtual void sample(const WorldView& world, const SampleItem& item) const = 0;
};

struct VirtualSensorOps {
  InstanceOps instance;
  std::uint64_t state_size = 0;  ///< Bytes of SampleItem::state.
  int (*configure)(void* instance, const VirtualSensorSetup* setup, VirtualDeclaration* declaration,
                   ErrorText* error) = nullptr;
  /// Samples `count` robots. Sets `failed[i]` to 1 and `error` where the driver threw.
  void (*sample)(const void* instance, const WorldView* world, const SampleItem* items,
                 std::uint64_t count, std::uint8_t* failed, ErrorText* error) = nullptr;
};

namespace detail {
template <class T>
constexpr std::size_t state_size_of() noexcept {
  if constexpr (requires { typename T::State; }) {
    static_assert(std::is_trivially_copyable_v<typename T::State>);
    return sizeof(typename T::State);
  } else {
    return 0;
  }
}

template <class T>
constexpr VirtualSensorOps virtual_sensor_ops() noexcept {
  VirtualSensorOps ops;
  ops.instance = instance_ops<T>();
  ops.state_size = state_size_of<T>();
  ops.configure = [](void* instance, const VirtualSensorSetup* setup,
                     VirtualDeclaration* declaration, ErrorText* error) {
    return guarded(error,
                   [&] { return static_cast<T*>(instance)->configure(*setup, *declaration); });
  };
  ops.sample = [](const void* instance, const WorldView* world, const SampleItem* items,
                  std::uint64_t count, std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      const int status = guarded(error, [&]() -> Status {
        static_cast<const T*>(instance)->T::sample(*world, items[i]);
        return {};
      });
      if (status != 0) {
        failed[i] = 1;
        error->slot = static_cast<std::uint32_t>(i);
      }
    }
  };
  return ops;
}
}  // namespace detail

/// Registers a virtual sensor: T::kReading says what it gives; T::State, if it has one, is a
/// trivially copyable struct kept per robot.
template <class T>
void add_virtual_sensor(RegistrySink& registry, const Description& description) {
  static constexpr VirtualSensorOps kOps = detail::virtual_sensor_ops<T>();
  registry.add(
      description.info(DriverKind::kVirtualSensor, static_cast<std::uint32_t>(T::kReading)), &kOps);
}

/// Raised by hand when the meaning of the virtual interface changes while its layout stays.
inline constexpr std::uint64_t kVirtualInterfaceVersion = 1;

/// A number that changes with the layout of the virtual-driver interface.
constexpr std::uint64_t virtual_interface_hash() noexcept {
  return detail::hash_layout(
      kVirtualInterfaceVersion,
      {sizeof(FanQuery), sizeof(VirtualDeclaration), offsetof(VirtualDeclaration, fan),
       sizeof(VirtualSensorSetup), sizeof(SampleItem), offsetof(SampleItem, header),
       sizeof(VirtualSensorOps), sizeof(Landmark), sizeof(RayHit), sizeof(TouchState)});
}

}  // namespace rave

/// As RAVE_PLUGIN, for plug-ins with virtual drivers.
#define RAVE_VIRTUAL_PLUGIN(provides)                                                \
  RAVE_PLUGIN_WITH_STAMP_(::rave::plugin::make_stamp(::rave::robot_interface_hash(), \
                                                     ::rave::virtual_interface_hash(), provides))
