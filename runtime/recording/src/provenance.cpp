// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/provenance.hpp"

#include <fmt/ranges.h>
#include <sodium.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/base/file.hpp"
#include "rave/base/named_path.hpp"
#include "rave/base/regular_file.hpp"

namespace rave::runtime {
// A recording repeats only with the same inputs. So it has the maps, the SHA-256 of each file that
// sensors read, and the versions of all drivers; `rave verify` compares both before it runs.
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// Files up to this size go into the recording, as long as it does not become large by them.
constexpr std::uintmax_t kSmall = std::uintmax_t{4} << 20U;
constexpr std::uintmax_t kSmallTogether = std::uintmax_t{16} << 20U;

std::uintmax_t bytes_of(const record::AttachedFiles& files) {
  std::uintmax_t bytes = 0;
  for (const auto& [digest, file] : files) bytes += file.content->size();
  return bytes;
}

/// `alone`: a driver needs only files that it has named, so copies elsewhere do as well.
void add_file(const fs::path& path, bool alone, record::RunInfo& info) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return;
  const std::string name = fs::absolute(path, error).lexically_normal().string();
  if (error || info.inputs.contains(name)) return;
  const std::uintmax_t size = fs::file_size(path, error);
  // A file that cannot be read is left out.
  if (alone && !error && size <= kSmall && bytes_of(info.files) + size <= kSmallTogether) {
    if (auto content = read_file(path, kSmall)) {
      const std::string digest = sha256_of(*content);
      info.inputs[name] = digest;
      info.files.try_emplace(digest, path.filename().string(),
                             std::make_shared<const std::string>(*std::move(content)));
    }
  } else if (auto digest = sha256_of_file(path)) {
    info.inputs[name] = *std::move(digest);
  }
}

void add_recording(const std::string& report, const fs::path& folder, record::RunInfo& info) {
  // Drivers that play a file name it in their report, so no list of such drivers is needed here.
  const auto json = nlohmann::json::parse(report, nullptr, false);
  if (!json.is_object() || !json.contains("file") || !json["file"].is_string()) return;
  // A log is one file, whose path they were given as such; `file` is only its name.
  if (json.contains("log") && json["log"].is_string()) {
    const fs::path log = named_path(folder, json["log"].get<std::string>());
    add_file(log, true, info);
    for (const auto& name : json.value("beside", nlohmann::json::array())) {
      if (name.is_string()) add_file(log.parent_path() / name.get<std::string>(), true, info);
    }
    return;
  }
  fs::path path = folder;
  const bool of_folder = json.contains("folder") && json["folder"].is_string();
  if (of_folder) path = named_path(path, json["folder"].get<std::string>());
  add_file(named_path(path, json["file"].get<std::string>()), !of_folder, info);
}

void add_version(plugin::Catalogue& catalogue, std::span<const DriverKind> kinds,
                 std::string_view what, const std::string& name, Files& versions) {
  const auto driver = catalogue.find(kinds, name);
  if (driver) versions[fmt::format("{} {}", what, name)] = (*driver)->info.version;
}

}  // namespace

Result<std::string> sha256_of_file(const fs::path& path) {
  // A pipe or device would block or never end.
  RAVE_TRY_ASSIGN(const int opened, open_regular_file(path));
  Descriptor descriptor(opened);
  const std::unique_ptr<std::FILE, CloseFile> file(::fdopen(descriptor.get(), "rb"));
  if (file == nullptr) return fail(ErrorCode::kIo, "cannot read `{}`", path.string());
  // The stream closes it.
  static_cast<void>(descriptor.release());
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  // A block at a time, since recordings may be larger than the memory.
  std::vector<unsigned char> block(std::size_t{1} << 20);
  while (true) {
    const std::size_t size = std::fread(block.data(), 1, block.size(), file.get());
    if (size == 0) break;
    crypto_hash_sha256_update(&state, block.data(), size);
  }
  if (std::ferror(file.get()) != 0) {
    return fail(ErrorCode::kIo, "cannot read `{}`", path.string());
  }
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest;
  crypto_hash_sha256_final(&state, digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest;
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                     bytes.size());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

void add_maps(const config::ExpandedScenario& scenario, record::RunInfo& info) {
  for (const auto& [path, content] : scenario.files.all()) {
    const std::string digest = sha256_of(*content);
    info.inputs[path] = digest;
    info.files.try_emplace(digest, fs::path(path).filename().string(), content);
  }
}

void add_played_files(const sim::Engine& engine, record::RunInfo& info) {
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      if (type.sensors[s].virtual_ops != nullptr) continue;
      add_recording(engine.sensor_report(RobotId(r), s), type.folder, info);
    }
  }
}

Files versions_of(const sim::EngineSpec& spec, plugin::Catalogue& catalogue) {
  constexpr std::array kSensors = {DriverKind::kSensor, DriverKind::kVirtualSensor,
                                   DriverKind::kHybridSensor};
  constexpr std::array kActuators = {DriverKind::kActuator, DriverKind::kVirtualActuator};
  constexpr std::array kControllers = {DriverKind::kController};
  constexpr std::array kPrograms = {DriverKind::kProgram};
  Files versions = {{"rave", RAVE_VERSION}};
  std::vector<std::uint8_t> here(spec.types.size(), spec.local ? 0 : 1);
  if (spec.local) {
    // Versions of drivers that this host does not load are unknown to it.
    for (const RobotId robot : *spec.local) here[spec.robots[robot.value()].type] = 1;
  }
  for (std::size_t t = 0; t < spec.types.size(); ++t) {
    if (here[t] == 0) continue;
    const sim::RobotType& type = spec.types[t];
    for (const auto& sensor : type.sensors) {
      add_version(catalogue, kSensors, "driver", sensor.driver, versions);
    }
    for (const auto& actuator : type.actuators) {
      add_version(catalogue, kActuators, "driver", actuator.driver, versions);
    }
    for (const auto& controller : type.controllers) {
      add_version(catalogue, kControllers, "driver", controller.driver, versions);
    }
    if (type.program) {
      add_version(catalogue, kPrograms, "program", type.program->driver, versions);
    }
  }
  return versions;
}

}  // namespace rave::runtime
