// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/actuator.hpp"
#include "rave/robot/device.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::testing {

/// Values of parameters that differ from their defaults.
using Given = std::map<std::string, std::variant<double, std::string, std::vector<double>>>;

/// The values in the order of the specs, with defaults filled in.
[[nodiscard]] inline plugin::ParamSet values_of(const DriverInfo& info, const Given& given) {
  plugin::ParamSet set;
  std::size_t used = 0;
  for (const ParamSpec& spec : info.param_specs()) {
    const auto found = given.find(spec.name);
    const bool there = found != given.end();
    used += there ? 1U : 0U;
    if (spec.type == ParamType::kText || spec.type == ParamType::kChoice) {
      set.add_text(spec.name, there ? std::get<std::string>(found->second) : spec.default_text);
    } else if (spec.type == ParamType::kNumbers) {
      set.add_list(spec.name,
                   there ? std::get<std::vector<double>>(found->second) : std::vector<double>());
    } else {
      set.add_number(spec.name, there ? std::get<double>(found->second) : spec.default_number);
    }
  }
  EXPECT_EQ(used, given.size()) << "a parameter that the driver does not declare";
  return set;
}

/// A plug-in of the build tree and its drivers.
class LivePlugin final : public RegistrySink {
 public:
  explicit LivePlugin(const std::string& name) {
    const std::string path = RAVE_BINARY_DIR "/lib/rave/plugins/" + name + ".so";
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      ADD_FAILURE() << dlerror();
      return;
    }
    void* symbol = dlsym(library, "rave_register_plugin");
    if (symbol != nullptr) reinterpret_cast<void (*)(RegistrySink*)>(symbol)(this);
  }
  void add(const DriverInfo& driver, const void* table) override {
    drivers_[driver.name] = {driver, table};
  }
  [[nodiscard]] const DriverInfo& info(const std::string& name) const {
    return drivers_.at(name).first;
  }
  template <class Ops>
  [[nodiscard]] const Ops& ops(const std::string& name) const {
    return *static_cast<const Ops*>(drivers_.at(name).second);
  }

 private:
  std::map<std::string, std::pair<DriverInfo, const void*>> drivers_;
};

/// One instance of a driver, called through its function table like in a host. Functions that
/// return a text return the error, or an empty text.
template <class Ops>
class LiveInstance {
 public:
  LiveInstance(const LivePlugin& plugin, const std::string& name)
      : info_(plugin.info(name)), ops_(plugin.ops<Ops>(name)) {
    const InstanceOps& make = ops_.instance;
    instance_ = ::operator new(make.size, std::align_val_t(make.alignment));
    EXPECT_EQ(make.construct(instance_, &error_), 0) << error_.text;
  }
  LiveInstance(const LiveInstance&) = delete;
  LiveInstance& operator=(const LiveInstance&) = delete;
  ~LiveInstance() {
    ops_.close(instance_);
    ops_.instance.destroy(instance_);
    ::operator delete(instance_, std::align_val_t(ops_.instance.alignment));
  }

  void close() { ops_.close(instance_); }
  [[nodiscard]] const DriverInfo& info() const { return info_; }

 protected:
  template <class Setup>
  void fill(Setup& setup, const Given& given) {
    params_ = values_of(info_, given);
    setup.params = params_.values().data();
    setup.param_count = params_.values().size();
  }
  [[nodiscard]] nlohmann::json report_of() {
    std::string text;
    ops_.report(instance_, &text, [](void* context, const char* bytes, std::uint64_t size) {
      static_cast<std::string*>(context)->assign(bytes, size);
    });
    return nlohmann::json::parse(text);
  }

  DriverInfo info_;
  const Ops& ops_;
  void* instance_ = nullptr;
  plugin::ParamSet params_;
  ErrorText error_;
};

class LiveDevice : public LiveInstance<HardwareDeviceOps> {
 public:
  using LiveInstance::LiveInstance;
  std::string configure(const Given& given, HostServices host = {}) {
    HardwareDeviceSetup setup;
    fill(setup, given);
    setup.host = host;
    return ops_.configure(instance_, &setup, &error_) == 0 ? "" : error_.text;
  }
  std::string open() { return ops_.open(instance_, &error_) == 0 ? "" : error_.text; }
  [[nodiscard]] HardwareDevice* base() { return ops_.base(instance_); }
  [[nodiscard]] nlohmann::json report() { return report_of(); }
};

class LiveSensor : public LiveInstance<HardwareSensorOps> {
 public:
  using LiveInstance::LiveInstance;
  std::string configure(const Given& given, HardwareDevice* device = nullptr) {
    HardwareSetup setup;
    fill(setup, given);
    setup.device = device;
    return ops_.configure(instance_, &setup, &declaration_, &error_) == 0 ? "" : error_.text;
  }
  std::string open(SampleSink& sink) {
    return ops_.open(instance_, &sink, &error_) == 0 ? "" : error_.text;
  }
  [[nodiscard]] nlohmann::json report() { return report_of(); }
  [[nodiscard]] const HardwareDeclaration& declaration() const { return declaration_; }

 private:
  HardwareDeclaration declaration_;
};

class LiveActuator : public LiveInstance<HardwareActuatorOps> {
 public:
  using LiveInstance::LiveInstance;
  std::string open(const Given& given, HardwareDevice* device = nullptr) {
    DeviceSetup setup;
    fill(setup, given);
    setup.device = device;
    return ops_.open(instance_, &setup, &error_) == 0 ? "" : error_.text;
  }
  std::string write(const Command& command) {
    return ops_.write(instance_, &command, 0, &error_) == 0 ? "" : error_.text;
  }
};

}  // namespace rave::testing
