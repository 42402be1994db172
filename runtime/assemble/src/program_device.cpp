// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "device_tools.hpp"
#include "rave/isolation/isolated_program.hpp"

namespace rave::runtime {
namespace {

/// Adapts a program in a process of its own to the interface of the engine.
class Isolated final : public sim::ProgramProcess {
 public:
  explicit Isolated(std::unique_ptr<isolation::IsolatedProgram> program)
      : program_(std::move(program)) {}
  Status begin(const DecideItem& item) override { return program_->begin_decide(item); }
  Status end(const DecideItem& item) override { return program_->end_decide(item); }
  Status update(std::span<const ParamValue> params, double radius_m) override {
    return program_->update(params, radius_m);
  }

 private:
  std::unique_ptr<isolation::IsolatedProgram> program_;
};

sim::ProgramProcessFactory isolated_factory(const DeviceContext& context,
                                            const plugin::Driver& driver) {
  // Captured by value: the factory is called once per robot, after `driver` and the context may
  // have gone.
  isolation::IsolationOptions options;
  options.runner = context.options.program_runner;
  options.plugin = driver.file;
  options.program = driver.info.name;
  return [options](const ProgramSetup& setup) -> Result<std::unique_ptr<sim::ProgramProcess>> {
    RAVE_TRY_ASSIGN(auto program, isolation::IsolatedProgram::start(options, setup));
    return std::make_unique<Isolated>(std::move(program));
  };
}

/// A program does not know where its robot file is, so the file that it reads gets a whole path.
codec::RawNode with_whole_path(const plugin::Driver& driver, const codec::RawNode& params,
                               const std::string& folder) {
  constexpr std::string_view kFile = "file";
  const auto specs = driver.info.param_specs();
  const bool reads = std::any_of(specs.begin(), specs.end(),
                                 [&](const ParamSpec& spec) { return spec.name == kFile; });
  const codec::RawNode* const given = reads ? params.find(kFile) : nullptr;
  const auto path = given == nullptr ? std::nullopt : given->as_text();
  if (!path || path->empty()) return params;
  codec::RawNode whole = params;
  const std::filesystem::path file = std::filesystem::path(folder) / *path;
  whole.set(kFile, codec::RawNode::text(std::filesystem::absolute(file).string()));
  return whole;
}

}  // namespace

Status add_program(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type) {
  if (!group.robot.program) return {};
  const config::ProgramFile& file = *group.robot.program;
  constexpr std::array kKinds = {DriverKind::kProgram};
  RAVE_TRY_ASSIGN(const plugin::Driver* const driver, find_driver(context, kKinds, file.driver));
  sim::ProgramSpec program;
  program.driver = driver->info.name;
  program.where = file.driver.where;
  program.ops = static_cast<const ProgramOps*>(driver->ops);
  RAVE_TRY_ASSIGN(program.params,
                  read_params(*driver, with_whole_path(*driver, file.params, type.folder)));
  program.param_specs = driver->info.param_specs();
  set_rhythm(context, file, program);
  // The host loads the plug-in all the same, to read its description and parameters; only the
  // decisions happen in the child.
  if (file.isolate) program.isolate = isolated_factory(context, *driver);
  type.program = std::move(program);
  return {};
}

}  // namespace rave::runtime
