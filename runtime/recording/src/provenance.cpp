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
#include "rave/base/regular_file.hpp"
#include "rave/config/diagnostics.hpp"
#include "rave/config/yaml.hpp"

namespace rave::runtime {
// A recording repeats only with the same inputs. So it has the SHA-256 of each file that sensors or
// maps read, and the versions of all drivers; `rave verify` compares both before it runs.
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

void add_file(const fs::path& path, Files& files) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return;
  const std::string name = fs::absolute(path, error).lexically_normal().string();
  if (error || files.contains(name)) return;
  // A file that cannot be read is left out.
  if (auto hash = sha256_of_file(path)) files.emplace(name, *std::move(hash));
}

void add_map(const fs::path& yaml, Files& files) {
  add_file(yaml, files);
  // The image of a map is an input of its own, which the YAML file only names.
  const auto text = read_file(yaml, config::kMaxFileBytes);
  if (!text) return;
  config::Diagnostics diagnostics;
  const auto root = config::parse_yaml(*text, yaml.string(), diagnostics);
  if (!root || !root->is_mapping()) return;
  const config::RawNode* const image = root->find("image");
  if (image != nullptr) add_file(yaml.parent_path() / image->scalar(), files);
}

void add_recording(const std::string& report, const fs::path& folder, Files& files) {
  // Drivers that play a file name it in their report, so no list of such drivers is needed here.
  const auto json = nlohmann::json::parse(report, nullptr, false);
  if (!json.is_object() || !json.contains("file") || !json["file"].is_string()) return;
  fs::path path = folder;
  if (json.contains("folder") && json["folder"].is_string()) {
    path /= json["folder"].get<std::string>();
  }
  add_file(path / json["file"].get<std::string>(), files);
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

Files input_files(const config::ExpandedScenario& scenario, const sim::Engine& engine) {
  Files files;
  for (const config::MapFile& map : scenario.world.maps) add_map(map.file.value, files);
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      if (type.sensors[s].virtual_ops != nullptr) continue;
      add_recording(engine.sensor_report(RobotId(r), s), type.folder, files);
    }
  }
  return files;
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
