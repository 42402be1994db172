// SPDX-License-Identifier: Apache-2.0
// A plug-in: its stamp is compared before it is loaded, and what it registers is compared with its
// stamp.
#include "plugin_file.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>

#include "description_check.hpp"
#include "rave/plugin/registry.hpp"

namespace rave::plugin {
namespace {

constexpr const char* kEntryName = "rave_register_plugin";

class Collector final : public RegistrySink {
 public:
  explicit Collector(const std::filesystem::path& file) : file_(file) {}
  void add(const DriverInfo& info, const void* ops) override {
    drivers.push_back(Driver{info, ops, file_});
  }
  std::vector<Driver> drivers;

 private:
  std::filesystem::path file_;
};

/// The text of dlerror() without the path, which our message already has, and with demangled
/// symbols.
std::string loader_reason(const std::filesystem::path& path) {
  const char* raw = ::dlerror();
  std::string reason = raw == nullptr ? "unknown reason" : raw;
  const std::string prefix = path.string() + ": ";
  if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
  const std::size_t begin = reason.find("_Z");
  if (begin == std::string::npos) return reason;
  const std::string symbol = reason.substr(begin, reason.find_first_of(" ,:\t", begin) - begin);
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> words(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
  return words ? fmt::format("{} ({})", reason, words.get()) : reason;
}

Status call_entry(void* entry, RegistrySink& sink) {
  using Entry = void (*)(RegistrySink*);
  try {
    reinterpret_cast<Entry>(entry)(&sink);
  } catch (const std::exception& error) {
    return fail(ErrorCode::kPlugin, "`{}` threw: {}", kEntryName, error.what());
  } catch (...) {
    return fail(ErrorCode::kPlugin, "`{}` threw", kEntryName);
  }
  return {};
}

/// Checks that the registered drivers are those of the stamp's list.
Status check_against_stamp(const std::vector<Driver>& drivers,
                           const std::vector<std::string>& provides) {
  for (auto driver = drivers.begin(); driver != drivers.end(); ++driver) {
    const std::string_view name = driver->info.name;
    if (std::find(provides.begin(), provides.end(), name) == provides.end()) {
      return fail(ErrorCode::kPlugin,
                  "it registers {} `{}`, which its stamp does not list: add the name to "
                  "RAVE_PLUGIN(...)",
                  to_string(driver->info.kind), name);
    }
    // The same name is allowed for drivers of different kinds.
    if (std::any_of(drivers.begin(), driver, [&](const Driver& other) {
          return other.info.kind == driver->info.kind && name == other.info.name;
        })) {
      return fail(ErrorCode::kPlugin, "it registers {} `{}` twice", to_string(driver->info.kind),
                  name);
    }
  }
  for (const std::string& name : provides) {
    if (std::none_of(drivers.begin(), drivers.end(),
                     [&](const Driver& driver) { return name == driver.info.name; })) {
      return fail(ErrorCode::kPlugin, "its stamp lists `{}`, which it does not register", name);
    }
  }
  if (drivers.empty()) return fail(ErrorCode::kPlugin, "it registers no driver");
  return {};
}

}  // namespace

PluginFile::PluginFile(std::filesystem::path path, const Stamp& host) : path_(std::move(path)) {
  // Read from the file without loading it: dlopen() would already run code of a plug-in that does
  // not fit.
  const Result<Stamp> stamp = read_stamp(path_);
  if (!stamp) {
    refuse(stamp.error());
    return;
  }
  provides_ = parse_provides(*stamp);
  if (const Status match = check_stamp(*stamp, host); !match) refuse(match.error());
}

PluginFile::~PluginFile() { unload(); }

bool PluginFile::claims(std::string_view name) const {
  // A file without a readable stamp is asked by its name, so that its error is shown to who wants
  // that driver.
  if (provides_.empty()) return path_.stem() == name;
  return std::find(provides_.begin(), provides_.end(), name) != provides_.end();
}

void PluginFile::refuse(Error reason) {
  error_ = std::move(reason).with_context(fmt::format("cannot use plug-in `{}`", path_.string()));
}

Status PluginFile::load() {
  if (!error_ && !loaded()) {
    Status status = open_library();
    if (status) status = register_drivers();
    if (!status) {
      unload();
      refuse(std::move(status).error());
    }
  }
  if (error_) return tl::unexpected(*error_);
  return {};
}

Status PluginFile::open_library() {
  // RTLD_NOW: a missing symbol must show here and not during a run. RTLD_LOCAL: plug-ins must not
  // see each other's symbols.
  int flags = RTLD_NOW | RTLD_LOCAL;
#if defined(__SANITIZE_THREAD__)
  // The thread sanitizer fails when a library named in its suppressions is unloaded, as the bus is
  // with the last plug-in that uses it.
  flags |= RTLD_NODELETE;
#endif
  handle_ = ::dlopen(path_.c_str(), flags);
  if (handle_ == nullptr) return fail(ErrorCode::kPlugin, "{}", loader_reason(path_));
  return {};
}

Status PluginFile::register_drivers() {
  void* entry = ::dlsym(handle_, kEntryName);
  if (entry == nullptr) {
    return fail(ErrorCode::kPlugin,
                "entry point `{}` is missing ({}); RAVE_PLUGIN(...) defines it; do not hide it",
                kEntryName, loader_reason(path_));
  }
  Collector collector(path_);
  RAVE_TRY(call_entry(entry, collector));
  for (const Driver& driver : collector.drivers) {
    RAVE_TRY(check_description(driver.info, driver.ops));
  }
  RAVE_TRY(check_against_stamp(collector.drivers, provides_));
  drivers_ = std::move(collector.drivers);
  return {};
}

void PluginFile::unload() noexcept {
  // First, because descriptions point into the library.
  drivers_.clear();
  if (handle_ != nullptr) ::dlclose(handle_);
  handle_ = nullptr;
}

}  // namespace rave::plugin
