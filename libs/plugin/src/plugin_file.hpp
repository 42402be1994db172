// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/plugin/stamp.hpp"

namespace rave::plugin {

/// One file of a plug-in folder: its stamp is read first, later it is loaded or permanently
/// rejected. Owns the loaded library and unloads it on destruction.
class PluginFile {
 public:
  /// Reads and checks the stamp; a file that fails is kept with its error.
  PluginFile(std::filesystem::path path, const Stamp& host);
  PluginFile(const PluginFile&) = delete;
  PluginFile& operator=(const PluginFile&) = delete;
  ~PluginFile();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// The names in the stamp; empty if it could not be read.
  [[nodiscard]] const std::vector<std::string>& provides() const noexcept { return provides_; }
  /// Whether the file provides or may provide driver `name`: its stamp lists it, or the stamp is
  /// unreadable and the file has that name.
  [[nodiscard]] bool claims(std::string_view name) const;

  /// Set if the file was rejected; the message names the file.
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }
  [[nodiscard]] bool loaded() const noexcept { return handle_ != nullptr; }
  void refuse(Error reason);

  /// Loads the library and its drivers once; later calls return the same result.
  Status load();

  /// Unloads the library; everything made from its drivers must be destroyed before.
  void unload() noexcept;

  /// Empty until loaded. Addresses are valid for the life of this object.
  [[nodiscard]] const std::vector<Driver>& drivers() const noexcept { return drivers_; }

 private:
  Status open_library();
  Status register_drivers();

  std::filesystem::path path_;
  std::vector<std::string> provides_;
  std::optional<Error> error_;
  void* handle_ = nullptr;
  std::vector<Driver> drivers_;
};

}  // namespace rave::plugin
