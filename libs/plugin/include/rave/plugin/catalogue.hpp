// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/registry.hpp"
#include "rave/plugin/stamp.hpp"

namespace rave::plugin {

/// An available driver and the plug-in file that provides it.
struct Driver {
  DriverInfo info;
  const void* ops = nullptr;
  std::filesystem::path file;
};

/// A file in a plug-in folder that could not be used, with the reason.
struct RejectedPlugin {
  std::filesystem::path file;
  Error error;
};

/// The plug-ins of a list of folders: found by their stamps, loaded on demand. Belongs to one
/// thread. The destructor unloads all plug-ins in reverse order, so everything made from them must
/// be destroyed before.
class Catalogue {
 public:
  /// `host` is the stamp that plug-ins must match.
  explicit Catalogue(const Stamp& host);
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  ~Catalogue();

  /// Reads the stamp of every `*.so` of a folder without loading it. A file that cannot be used is
  /// listed in rejected() and does not affect the others. If two folders provide the same name, the
  /// one added first wins; within one folder that is an error of find(). Errors: kNotFound, kIo.
  Status add_folder(const std::filesystem::path& folder);

  /// Loads the plug-in file `path`; its drivers take precedence over those of the folders. Errors,
  /// each naming the file: those of read_stamp and check_stamp; kPlugin (unresolved symbol, no
  /// entry point, registered drivers that differ from the stamp's list, an invalid description).
  Status load(const std::filesystem::path& path);

  /// The driver `name` of one of `kinds`. Loads only the file whose stamp lists `name`; if there is
  /// none, all files, to list them in the message. Errors: kNotFound with the nearest name, the
  /// available drivers and the rejected files; the reason why the file with that name was rejected;
  /// kPlugin if two files of one folder provide it.
  [[nodiscard]] Result<const Driver*> find(std::span<const DriverKind> kinds,
                                           std::string_view name);

  /// Loads all files and returns every driver that find() can return, ordered by kind and name.
  [[nodiscard]] std::vector<const Driver*> all();

  /// The files rejected so far. The reasons name the files.
  [[nodiscard]] const std::vector<RejectedPlugin>& rejected() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::plugin
