// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
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
/// Belongs to one thread. Plug-ins stay loaded until the catalogue is destroyed, so everything
/// that was made from them must be gone by then.
class Catalogue {
 public:
  /// `host` is the stamp that plug-ins must match.
  explicit Catalogue(const Stamp& host);
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  ~Catalogue();

  /// Notes every `*.so` of a folder. Folders added earlier win when two files have one name.
  /// Errors: kNotFound.
  Status add_folder(const std::filesystem::path& folder);

  /// Loads the plug-in file `path` now and registers its drivers.
  /// Errors: those of read_stamp and check_stamp; kPlugin (unresolved symbol, no entry point,
  /// two drivers of one kind and name), each naming file, symbol and reason.
  Status load(const std::filesystem::path& path);

  /// The driver `name` of one of `kinds`. Loads the file `<name>.so` if there is one, and all
  /// others only when it did not help. Errors: kNotFound with the drivers that there are and the
  /// rejected files, or the reason why the file of that name was rejected.
  [[nodiscard]] Result<const Driver*> find(std::span<const DriverKind> kinds,
                                           std::string_view name);

  /// Loads everything and returns it, ordered by kind and name.
  [[nodiscard]] std::vector<const Driver*> all();

  /// Files that load() or all() or find() had to refuse so far.
  [[nodiscard]] const std::vector<RejectedPlugin>& rejected() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::plugin
