// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::testing {

/// Values of parameters that differ from the default.
using Given = std::map<std::string, std::variant<double, std::string>>;

/// One instance of a sensor driver of the build tree, called through its table of functions as a
/// host does it.
class LiveDriver {
 public:
  explicit LiveDriver(const std::string& name) : registered_(load(name)) {
    const InstanceOps& make = ops().instance;
    instance_ = ::operator new(make.size, std::align_val_t(make.alignment));
    EXPECT_EQ(make.construct(instance_, &error_), 0) << error_.text;
  }
  LiveDriver(const LiveDriver&) = delete;
  LiveDriver& operator=(const LiveDriver&) = delete;
  ~LiveDriver() {
    ops().close(instance_);
    ops().instance.destroy(instance_);
    ::operator delete(instance_, std::align_val_t(ops().instance.alignment));
  }

  /// Empty, or the text of the error.
  std::string configure(const Given& given) {
    params_ = values(given);
    HardwareSetup setup;
    setup.params = params_.values().data();
    setup.param_count = params_.values().size();
    return ops().configure(instance_, &setup, &declaration_, &error_) == 0 ? "" : error_.text;
  }
  std::string open(SampleSink& sink) {
    return ops().open(instance_, &sink, &error_) == 0 ? "" : error_.text;
  }
  void close() { ops().close(instance_); }
  [[nodiscard]] nlohmann::json report() {
    std::string text;
    ops().report(instance_, &text, [](void* context, const char* bytes, std::uint64_t size) {
      static_cast<std::string*>(context)->assign(bytes, size);
    });
    return nlohmann::json::parse(text);
  }
  [[nodiscard]] const HardwareDeclaration& declaration() const { return declaration_; }
  [[nodiscard]] const DriverInfo& info() const { return registered_.info; }

 private:
  class Registered final : public RegistrySink {
   public:
    void add(const DriverInfo& driver, const void* table) override {
      info = driver;
      ops = static_cast<const HardwareSensorOps*>(table);
    }
    DriverInfo info;
    const HardwareSensorOps* ops = nullptr;
  };

  static Registered load(const std::string& name) {
    const std::string path = RAVE_BINARY_DIR "/lib/rave/plugins/" + name + ".so";
    Registered registered;
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      ADD_FAILURE() << dlerror();
      return registered;
    }
    void* symbol = dlsym(library, "rave_register_plugin");
    if (symbol != nullptr) reinterpret_cast<void (*)(RegistrySink*)>(symbol)(&registered);
    return registered;
  }

  [[nodiscard]] const HardwareSensorOps& ops() const { return *registered_.ops; }

  /// In the order of the specs, defaults filled in.
  [[nodiscard]] plugin::ParamSet values(const Given& given) const {
    plugin::ParamSet set;
    std::size_t used = 0;
    for (const ParamSpec& spec : info().param_specs()) {
      const auto found = given.find(spec.name);
      const bool there = found != given.end();
      used += there ? 1U : 0U;
      if (spec.type == ParamType::kText || spec.type == ParamType::kChoice) {
        set.add_text(spec.name, there ? std::get<std::string>(found->second) : spec.default_text);
      } else {
        set.add_number(spec.name, there ? std::get<double>(found->second) : spec.default_number);
      }
    }
    EXPECT_EQ(used, given.size()) << "a parameter that the driver does not declare";
    return set;
  }

  Registered registered_;
  void* instance_ = nullptr;
  plugin::ParamSet params_;
  HardwareDeclaration declaration_;
  ErrorText error_;
};

}  // namespace rave::testing
