// SPDX-License-Identifier: Apache-2.0
#include "program_file.hpp"

#include <dlfcn.h>

#include <string>

#include "rave/plugin/registry.hpp"

namespace rave::isolation {

struct ProgramFile::Impl final : RegistrySink {
  std::string wanted;
  const ProgramOps* ops = nullptr;
  void add(const DriverInfo& info, const void* table) override {
    if (info.kind == DriverKind::kProgram && info.name == wanted) {
      ops = static_cast<const ProgramOps*>(table);
    }
  }
};

ProgramFile::ProgramFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ProgramFile::~ProgramFile() = default;

Result<std::unique_ptr<ProgramFile>> ProgramFile::load(const std::filesystem::path& file,
                                                       std::string_view program) {
  auto impl = std::make_unique<Impl>();
  impl->wanted = program;
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return fail(ErrorCode::kNotFound, "{}", ::dlerror());
  auto entry = reinterpret_cast<void (*)(RegistrySink*)>(::dlsym(handle, "rave_register_plugin"));
  if (entry == nullptr) return fail(ErrorCode::kPlugin, "{}: no entry point", file.string());
  entry(impl.get());
  if (impl->ops == nullptr) {
    return fail(ErrorCode::kNotFound, "{} has no program `{}`", file.string(), program);
  }
  std::unique_ptr<ProgramFile> result(new ProgramFile(std::move(impl)));
  result->ops_ = result->impl_->ops;
  return result;
}

}  // namespace rave::isolation
