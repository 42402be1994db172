// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "rave/base/random.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/world/world_view.hpp"

namespace rave {

/// A fan of rays that the engine casts for a virtual sensor. The driver then needs no loop of its
/// own: the engine casts the rays of all robots in one batch.
struct FanQuery {
  /// Directions of the `ray_count` rays in the sensor frame; valid as long as the instance.
  const double* bearings_rad = nullptr;
  std::uint32_t ray_count = 0;
  /// Each reading is the minimum of this many neighbouring rays: 1 for a laser, more for a cone.
  std::uint32_t rays_per_reading = 1;
  double range_min_m = 0;  ///< Shorter distances read as range_min_m.
  double range_max_m = 0;  ///< Longer distances are no return: +infinity.
};

/// Properties of a virtual sensor that follow from its parameters.
struct VirtualDeclaration {
  std::uint32_t capacity = 1;  ///< Largest number of records; ignored with a fan (one per reading).
  std::uint32_t uses_fan = 0;  ///< 1: `fan` is set and sample() is never called.
  FanQuery fan;
  double cone_rad = 0;  ///< Opening angle of a cone, for SensorInfo.
  /// Directions of the readings of a cone sensor, for SensorInfo; null: those of the fan.
  const double* reading_bearings_rad = nullptr;
};

/// Passed to a virtual sensor when it is configured. One object serves all robots with the same
/// driver and parameters.
struct VirtualSensorSetup {
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  LayerMask layers = kAllLayers;  ///< Layers that the robot file lets the sensor sense.
  std::uint32_t reserved = 0;
  double period_s = 0;
  double z_m = 0;  ///< Mounting height.
  /// The real half of the hybrid sensor that this is the virtual half of; otherwise null. Valid
  /// during configure().
  const SensorInfo* real_half = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// One sample of one robot: the pose to sense from and the memory to write to.
struct SampleItem {
  RobotId robot;
  std::uint32_t device = 0;
  std::uint64_t seed = 0;
  std::uint32_t sequence = 0;  ///< Number of this sample, from 0.
  std::uint32_t capacity = 0;
  Pose2 X_WR;  ///< Pose of the robot.
  Pose2 X_WS;  ///< Pose of the sensor.
  double z_m = 0;
  double elapsed_s = 0;  ///< Time since the last sample of this sensor (its period; 0 at first).
  SampleHeader* header = nullptr;  ///< The driver sets `count`; the engine sets the rest.
  void* records = nullptr;         ///< Room for `capacity` records.
  /// `state_size` bytes of this sensor of this robot; zero at the start and after a reset.
  void* state = nullptr;

  /// The random numbers for this sample. Noise of the robot file uses another stream.
  [[nodiscard]] RandomStream random() const noexcept {
    return {seed, robot.value(), device, sequence};
  }
};

/// A sensor of the virtual world. configure() is called once. Several threads may call sample() at
/// once for different robots, so it is const; variable data is in SampleItem::state.
class VirtualSensor {
 public:
  virtual ~VirtualSensor() = default;
  virtual Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) = 0;
  /// Writes the records of one robot. Not called for a sensor that declares a fan: only a range
  /// sensor with a fan may omit sample().
  virtual void sample(const WorldView& /*world*/, const SampleItem& /*item*/) const {}
};

struct VirtualSensorOps {
  InstanceOps instance;
  std::uint64_t state_size = 0;  ///< Size of SampleItem::state.
  int (*configure)(void* instance, const VirtualSensorSetup* setup, VirtualDeclaration* declaration,
                   ErrorText* error) = nullptr;
  /// Samples `count` robots. Where the driver throws, sets `failed[i]` to 1 and `error`.
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

/// Whether T has a sample() of its own.
template <class T>
inline constexpr bool samples_itself =
    !std::is_same_v<decltype(&T::sample), decltype(&VirtualSensor::sample)>;

template <class T>
Status configure_sensor(T& sensor, const VirtualSensorSetup& setup,
                        VirtualDeclaration& declaration) {
  RAVE_TRY(sensor.configure(setup, declaration));
  if (!samples_itself<T> && declaration.uses_fan == 0) {
    return fail(ErrorCode::kInvalidArgument, "the sensor declares no fan and has no sample()");
  }
  return {};
}

template <class T>
constexpr VirtualSensorOps virtual_sensor_ops() noexcept {
  static_assert(samples_itself<T> || T::kReading == ReadingKind::kRanges,
                "a virtual sensor whose readings are not ranges has a sample() of its own");
  VirtualSensorOps ops;
  ops.instance = instance_ops<T>();
  ops.state_size = state_size_of<T>();
  ops.configure = [](void* instance, const VirtualSensorSetup* setup,
                     VirtualDeclaration* declaration, ErrorText* error) {
    return guarded(
        error, [&] { return configure_sensor(*static_cast<T*>(instance), *setup, *declaration); });
  };
  ops.sample = [](const void* instance, const WorldView* world, const SampleItem* items,
                  std::uint64_t count, std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      guarded_slot(i, failed, error,
                   [&] { static_cast<const T*>(instance)->T::sample(*world, items[i]); });
    }
  };
  return ops;
}
}  // namespace detail

/// Registers a virtual sensor. T::kReading is the kind of its records; the optional T::State is a
/// trivially copyable struct that is kept per robot.
template <class T>
void add_virtual_sensor(RegistrySink& registry, const Description& description) {
  static constexpr VirtualSensorOps kOps = detail::virtual_sensor_ops<T>();
  registry.add(
      description.info(DriverKind::kVirtualSensor, static_cast<std::uint32_t>(T::kReading)), &kOps);
}

/// Increased by hand when the meaning of the virtual interface changes but its layout does not.
inline constexpr std::uint64_t kVirtualInterfaceVersion = 1;

/// A number that depends on the layout of the virtual-driver interface.
constexpr std::uint64_t virtual_interface_hash() noexcept {
  return detail::hash_layout(
      kVirtualInterfaceVersion,
      {sizeof(FanQuery), sizeof(VirtualDeclaration), offsetof(VirtualDeclaration, fan),
       sizeof(VirtualSensorSetup), sizeof(SampleItem), offsetof(SampleItem, header),
       sizeof(VirtualSensorOps), sizeof(Landmark), sizeof(RayHit), sizeof(TouchState)});
}

}  // namespace rave

/// Like RAVE_PLUGIN, for plug-ins with virtual drivers.
#define RAVE_VIRTUAL_PLUGIN(provides)                                                \
  RAVE_PLUGIN_WITH_STAMP_(::rave::plugin::make_stamp(::rave::robot_interface_hash(), \
                                                     ::rave::virtual_interface_hash(), provides))
