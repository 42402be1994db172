// SPDX-License-Identifier: Apache-2.0
// Finds drivers by name. Stamps say which file provides what; a file is loaded when one of its
// drivers is needed.
#include "rave/plugin/catalogue.hpp"

#include <algorithm>
#include <map>
#include <ranges>
#include <string>
#include <system_error>
#include <utility>

#include "plugin_file.hpp"
#include "rave/base/names.hpp"

namespace rave::plugin {
namespace {

namespace fs = std::filesystem;

/// The files of one folder, in the order of their names; or those named one by one.
struct Group {
  std::vector<PluginFile*> files;
  /// Names that two usable files provide, with the error message.
  std::map<std::string, Error, std::less<>> conflicts;
};

bool wanted(std::span<const DriverKind> kinds, DriverKind kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Of more names the message would fill the terminal, and its advice would be lost.
constexpr std::size_t kMostNames = 10;

/// `program`; `sensor driver` for real, virtual and hybrid sensors, which begin with the plain
/// kind; `driver` if any kind is permitted.
std::string kinds_text(std::span<const DriverKind> kinds) {
  if (kinds.empty()) return "driver";
  return std::string(to_string(kinds.front())) + (kinds.size() > 1 ? " driver" : "");
}

Result<std::vector<fs::path>> plugin_files_of(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code)) {
    return fail(ErrorCode::kNotFound, "there is no plug-in folder `{}`", folder.string());
  }
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
    if (entry->path().extension() == ".so") files.push_back(entry->path());
  }
  if (code) {
    return fail(ErrorCode::kIo, "cannot list plug-in folder `{}`: {}", folder.string(),
                code.message());
  }
  // The order of a folder is that of the file system; sorted, every machine finds the same first.
  std::sort(files.begin(), files.end());
  return files;
}

/// Finds names that two files of one folder provide, because nothing selects one of them.
void find_conflicts(Group& group) {
  std::map<std::string_view, PluginFile*> owners;
  for (PluginFile* file : group.files) {
    if (file->error()) continue;
    for (const std::string& name : file->provides()) {
      PluginFile*& owner = owners[name];
      if (owner == nullptr || owner == file) {
        owner = file;
        continue;
      }
      Error error{ErrorCode::kPlugin,
                  fmt::format("plug-ins `{}` and `{}` both provide `{}`: remove one of them",
                              owner->path().string(), file->path().string(), name),
                  {}};
      group.conflicts.emplace(name, error);
      file->refuse(std::move(error));
    }
  }
}

}  // namespace

struct Catalogue::Impl {
  explicit Impl(const Stamp& host_stamp) : host(host_stamp) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  // In the reverse order of loading: a later one may depend on an earlier one.
  ~Impl() {
    for (PluginFile* file : std::ranges::reverse_view(load_order)) file->unload();
  }

  std::pair<PluginFile*, bool> note(const fs::path& path);
  Status load(PluginFile& file);
  Result<const Driver*> find_in(const Group& group, std::span<const DriverKind> kinds,
                                std::string_view name);
  std::vector<const Driver*> load_all();
  Error unknown(std::span<const DriverKind> kinds, std::string_view name);
  void update_rejected();

  Stamp host;
  std::map<fs::path, std::unique_ptr<PluginFile>> files;  ///< By canonical path.
  std::vector<PluginFile*> load_order;
  std::vector<Group> groups{1};  ///< First the files of load(), then one group per folder.
  std::vector<fs::path>
      empty_folders;  ///< Without plug-ins, such as a project instead of its build.
  std::vector<RejectedPlugin> rejected;
};

/// The entry for the file at `path`, and whether it is new: one entry per file, whatever its path.
std::pair<PluginFile*, bool> Catalogue::Impl::note(const fs::path& path) {
  std::error_code code;
  fs::path absolute = fs::absolute(path, code);
  if (code) absolute = path;
  // One file under two paths would register its drivers twice.
  fs::path key = fs::canonical(absolute, code);
  if (code) key = absolute;  // A dangling link; reading its stamp reports that.
  auto& file = files[key];
  const bool is_new = file == nullptr;
  if (is_new) file = std::make_unique<PluginFile>(absolute, host);
  return {file.get(), is_new};
}

Status Catalogue::Impl::load(PluginFile& file) {
  const bool was_loaded = file.loaded();
  Status status = file.load();
  if (file.loaded() && !was_loaded) load_order.push_back(&file);
  update_rejected();
  return status;
}

/// The driver in one folder; nullptr if the folder has none of that name and kind.
Result<const Driver*> Catalogue::Impl::find_in(const Group& group,
                                               std::span<const DriverKind> kinds,
                                               std::string_view name) {
  if (const auto conflict = group.conflicts.find(name); conflict != group.conflicts.end()) {
    return tl::unexpected(conflict->second);
  }
  const PluginFile* refused = nullptr;
  for (PluginFile* file : group.files) {
    // The stamp names what a file provides, so only the file that is needed is loaded.
    if (!file->claims(name)) continue;
    if (!file->error()) {
      RAVE_TRY(load(*file));
      for (const Driver& driver : file->drivers()) {
        if (driver.info.name == name && wanted(kinds, driver.info.kind)) return &driver;
      }
      return nullptr;
    }
    // Another file of the folder may provide it; if none does, the reason why this one cannot be
    // used is the answer.
    refused = file;
  }
  if (refused != nullptr) return tl::unexpected(*refused->error());
  return nullptr;
}

/// Loads all usable files; returns the drivers that find() can return, by kind and name.
std::vector<const Driver*> Catalogue::Impl::load_all() {
  std::map<std::pair<DriverKind, std::string_view>, const Driver*> found;
  for (Group& group : groups) {
    for (PluginFile* file : group.files) {
      if (!load(*file)) continue;  // The reason is kept in `rejected`.
      for (const Driver& driver : file->drivers()) {
        // The first group that has a name hides it in the groups behind.
        found.try_emplace({driver.info.kind, driver.info.name}, &driver);
      }
    }
  }
  std::vector<const Driver*> drivers;
  for (const auto& [key, driver] : found) drivers.push_back(driver);
  return drivers;
}

Error Catalogue::Impl::unknown(std::span<const DriverKind> kinds, std::string_view name) {
  std::vector<std::string_view> names;
  std::string other_kinds;
  // Everything is loaded only now, to suggest a name: the run ends anyway.
  for (const Driver* driver : load_all()) {
    const std::string_view driver_name = driver->info.name;
    if (wanted(kinds, driver->info.kind)) {
      if (std::find(names.begin(), names.end(), driver_name) == names.end()) {
        names.push_back(driver_name);
      }
    } else if (driver_name == name) {
      other_kinds += fmt::format("; the `{}` of `{}` is a {}", name, driver->file.string(),
                                 to_string(driver->info.kind));
    }
  }
  std::sort(names.begin(), names.end());
  std::string message = fmt::format("there is no {} `{}`", kinds_text(kinds), name);
  const std::string_view nearest = nearest_name(name, names);
  if (!nearest.empty()) message += fmt::format("; did you mean `{}`?", nearest);
  message += other_kinds;
  if (nearest.empty()) {
    // Of dozens of names only those with the word in them, if there are any.
    std::vector<std::string_view> alike;
    std::ranges::copy_if(names, std::back_inserter(alike), [&](std::string_view each) {
      return !name.empty() && each.find(name) != std::string_view::npos;
    });
    if (!alike.empty()) {
      message += fmt::format("; names with it: {}", join_names(alike));
    } else if (names.size() > kMostNames) {
      message += fmt::format("; `rave drivers` lists the {} that there are", names.size());
    } else {
      message += fmt::format("; there are {}", join_names(names));
    }
  }
  message += "; the folder of your own plug-ins is given with --plugins or RAVE_PLUGIN_PATH";
  for (const fs::path& folder : empty_folders) {
    message += fmt::format("; there is no plug-in in `{}`", folder.string());
  }
  for (const RejectedPlugin& plugin : rejected) message += "; " + plugin.error.message;
  return Error{ErrorCode::kNotFound, std::move(message), {}};
}

void Catalogue::Impl::update_rejected() {
  rejected.clear();
  for (const auto& [path, file] : files) {
    if (file->error()) rejected.push_back({file->path(), *file->error()});
  }
}

Catalogue::Catalogue(const Stamp& host) : impl_(std::make_unique<Impl>(host)) {}

Catalogue::~Catalogue() = default;

Status Catalogue::add_folder(const std::filesystem::path& folder) {
  RAVE_TRY_ASSIGN(const std::vector<fs::path> paths, plugin_files_of(folder));
  if (paths.empty()) impl_->empty_folders.push_back(folder);
  Group group;
  for (const fs::path& path : paths) {
    const auto [file, is_new] = impl_->note(path);
    if (is_new) group.files.push_back(file);
  }
  find_conflicts(group);
  impl_->groups.push_back(std::move(group));
  impl_->update_rejected();
  return {};
}

Status Catalogue::load(const std::filesystem::path& path) {
  PluginFile* file = impl_->note(path).first;
  Group& named = impl_->groups.front();
  if (std::find(named.files.begin(), named.files.end(), file) == named.files.end()) {
    named.files.push_back(file);
    // Reports a second provider to the caller; the first one stays in use.
    find_conflicts(named);
    named.conflicts.clear();
  }
  return impl_->load(*file);
}

Result<const Driver*> Catalogue::find(std::span<const DriverKind> kinds, std::string_view name) {
  for (const Group& group : impl_->groups) {
    RAVE_TRY_ASSIGN(const Driver* const driver, impl_->find_in(group, kinds, name));
    if (driver != nullptr) return driver;
  }
  return tl::unexpected(impl_->unknown(kinds, name));
}

std::vector<const Driver*> Catalogue::all() { return impl_->load_all(); }

const std::vector<RejectedPlugin>& Catalogue::rejected() const noexcept { return impl_->rejected; }

}  // namespace rave::plugin
