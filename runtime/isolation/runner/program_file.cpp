// SPDX-License-Identifier: Apache-2.0
#include "program_file.hpp"

#include <array>
#include <utility>

#include "rave/plugin/catalogue.hpp"
#include "rave/robot/interface_hash.hpp"

namespace rave::isolation {

struct ProgramFile::Impl {
  // A program uses no part of the interface of virtual drivers, so that version is 0, which fits
  // any.
  plugin::Catalogue catalogue{plugin::make_stamp(robot_interface_hash(), 0, "")};
};

ProgramFile::ProgramFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ProgramFile::~ProgramFile() = default;

Result<std::unique_ptr<ProgramFile>> ProgramFile::load(const std::filesystem::path& file,
                                                       std::string_view program) {
  std::unique_ptr<ProgramFile> result(new ProgramFile(std::make_unique<Impl>()));
  plugin::Catalogue& catalogue = result->impl_->catalogue;
  RAVE_TRY(catalogue.load(file));
  constexpr std::array kKinds{DriverKind::kProgram};
  auto driver = catalogue.find(kKinds, program);
  if (!driver) return tl::unexpected(std::move(driver).error().with_context(file.string()));
  result->ops_ = static_cast<const ProgramOps*>((*driver)->ops);
  return result;
}

}  // namespace rave::isolation
