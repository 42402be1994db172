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

/// One driver that can be used, and the plug-in file it came from.
struct Driver {
  DriverInfo info;
  const void* ops = nullptr;
  std::filesystem::path file;
};

/// A file in a plug-in folder that could not be used, and why.
struct RejectedPlugin {
  std::filesystem::path file;
  Error error;
};

/// All plug-ins of a list of folders: found by their stamps, loaded only when asked for.
/// Belongs to one thread. Plug-ins stay loaded until the catalogue is destroyed, which unloads them
/// in reverse order, so everything that was made from them must be gone by then.
class Catalogue {
 public:
  /// `host` is the stamp that plug-ins must match.
  explicit Catalogue(const Stamp& host);
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  ~Catalogue();

  /// Reads the stamp of every `*.so` of a folder and loads none of them. A file that cannot be used
  /// is noted in rejected() and keeps nobody else from being used. Folders added earlier win when
  /// two files provide one name; within one folder that is an error of find().
  /// Errors: kNotFound, kIo.
  Status add_folder(const std::filesystem::path& folder);

  /// Loads the plug-in file `path` now; its drivers win over those of the folders.
  /// Errors, each naming the file: those of read_stamp and check_stamp; kPlugin (unresolved symbol,
  /// no entry point, what it registers is not what its stamp lists, an invalid description).
  Status load(const std::filesystem::path& path);

  /// The driver `name` of one of `kinds`. Loads only the file whose stamp lists `name`. If there is
  /// none it loads all, to say what there is.
  /// Errors: kNotFound with the nearest name, the drivers that there are and the rejected files;
  /// the reason why the file that has the name was rejected; kPlugin if two files of one folder
  /// provide it.
  [[nodiscard]] Result<const Driver*> find(std::span<const DriverKind> kinds,
                                           std::string_view name);

  /// Loads everything and returns what find() would give, ordered by kind and name.
  [[nodiscard]] std::vector<const Driver*> all();

  /// Files that had to be refused so far. The reasons name the files.
  [[nodiscard]] const std::vector<RejectedPlugin>& rejected() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::plugin
