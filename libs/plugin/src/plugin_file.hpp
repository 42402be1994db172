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

/// One file of a plug-in folder: noted by its stamp, then loaded or refused, for good.
/// Owns the loaded library and unloads it at its end.
class PluginFile {
 public:
  /// Reads and checks the stamp; a file that fails is kept with its error.
  PluginFile(std::filesystem::path path, const Stamp& host);
  PluginFile(const PluginFile&) = delete;
  PluginFile& operator=(const PluginFile&) = delete;
  ~PluginFile();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// What the stamp lists; empty if it could not be read.
  [[nodiscard]] const std::vector<std::string>& provides() const noexcept { return provides_; }
  /// Whether the file is, or seems to be, the home of driver `name`: its stamp lists it, or the
  /// stamp cannot be read and the file is called so.
  [[nodiscard]] bool claims(std::string_view name) const;

  /// Set once the file is refused; the message names the file.
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }
  [[nodiscard]] bool loaded() const noexcept { return handle_ != nullptr; }
  void refuse(Error reason);

  /// Loads the library and takes its drivers, once; then and later the error that it gave.
  Status load();

  /// Drops the drivers and the library; nothing made from them may be left.
  void unload() noexcept;

  /// Empty until loaded. The addresses stay for the life of this object.
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
