// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::recording {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Takes down what a plug-in registers.
class Registered final : public RegistrySink {
 public:
  void add(const DriverInfo& driver, const void* table) override {
    info = driver;
    ops = static_cast<const HardwareSensorOps*>(table);
    ++count;
  }
  DriverInfo info;
  const HardwareSensorOps* ops = nullptr;
  int count = 0;
};

/// The one driver of a plug-in of the build tree, which stays loaded.
inline Registered load_driver(const std::string& name) {
  const std::string path = RAVE_BINARY_DIR "/lib/rave/plugins/" + name + ".so";
  Registered registered;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    ADD_FAILURE() << dlerror();
    return registered;
  }
  void* symbol = dlsym(library, "rave_register_plugin");
  if (symbol != nullptr) reinterpret_cast<void (*)(RegistrySink*)>(symbol)(&registered);
  EXPECT_EQ(registered.count, 1) << path;
  return registered;
}

/// Values of parameters that differ from the default.
using Given = std::map<std::string, std::variant<double, std::string>>;

/// One instance of a driver, called through its table of functions.
class Player {
 public:
  explicit Player(const std::string& driver) : driver_(load_driver(driver)) {
    const InstanceOps& make = ops().instance;
    instance_ = ::operator new(make.size, std::align_val_t(make.alignment));
    EXPECT_EQ(make.construct(instance_, &error_), 0) << error_.text;
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  ~Player() {
    ops().instance.destroy(instance_);
    ::operator delete(instance_, std::align_val_t(ops().instance.alignment));
  }

  /// Empty, or the text of the error.
  std::string configure(const Given& given, const std::string& folder) {
    params_ = values(given);
    HardwareSetup setup;
    setup.params = params_.values().data();
    setup.param_count = params_.values().size();
    setup.folder = folder.c_str();
    return ops().configure(instance_, &setup, &declaration_, &error_) == 0 ? "" : error_.text;
  }
  std::string open(SampleSink& sink) {
    return ops().open(instance_, &sink, &error_) == 0 ? "" : error_.text;
  }
  void close() { ops().close(instance_); }
  [[nodiscard]] std::string report() {
    std::string text;
    ops().report(instance_, &text, [](void* context, const char* bytes, std::uint64_t size) {
      static_cast<std::string*>(context)->assign(bytes, size);
    });
    return text;
  }
  [[nodiscard]] const HardwareDeclaration& declaration() const { return declaration_; }
  [[nodiscard]] const DriverInfo& info() const { return driver_.info; }

 private:
  [[nodiscard]] const HardwareSensorOps& ops() const { return *driver_.ops; }

  /// As a host passes them: in the order of the specs, defaults filled in.
  [[nodiscard]] plugin::ParamSet values(const Given& given) const {
    plugin::ParamSet set;
    std::size_t used = 0;
    for (const ParamSpec& spec : driver_.info.param_specs()) {
      const auto found = given.find(spec.name);
      used += found == given.end() ? 0U : 1U;
      const bool is_text = spec.type == ParamType::kText || spec.type == ParamType::kChoice;
      if (is_text) {
        set.add_text(spec.name, found == given.end() ? spec.default_text
                                                     : std::get<std::string>(found->second));
      } else {
        set.add_number(spec.name, found == given.end() ? spec.default_number
                                                       : std::get<double>(found->second));
      }
    }
    EXPECT_EQ(used, given.size()) << "a parameter that the driver does not declare";
    return set;
  }

  Registered driver_;
  void* instance_ = nullptr;
  plugin::ParamSet params_;
  HardwareDeclaration declaration_;
  ErrorText error_;
};

}  // namespace rave::recording
