// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "lua_robot.hpp"
#include "lua_values.hpp"
#include "rave/base/file.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave::lua {
namespace {

constexpr std::size_t kMostSource = std::size_t{1} << 20U;

constexpr ParamSpec kParams[] = {
    required(text_param("file", "",
                        "The program, relative to the folder of the robot file. Set during a run, "
                        "it is loaded again and keeps its memory.")),
    text_param("with", "",
               "What its function param() gives, such as `speed = 0.3, colour = \"red\"`."),
    integer_param("instructions", 1'000'000, 1000, 1'000'000'000,
                  "Largest number of instructions of a decision."),
};

/// A decision process in Lua: the file defines decide(), and start() and on_order() if it needs
/// them. It keeps what is in its table `memory`.
class LuaProgram final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath | kTakesText;

  Status start(const Setup& setup) override {
    robot_.begin(setup);
    RAVE_TRY(load(setup.params()));
    if (!script_->defines("start")) return {};
    RAVE_TRY(script_->call("start", {}));
    return {};
  }

  Status parameters_changed(const Params& params) override { return load(params); }

  void decide(const Percepts& percepts, Commands& commands) override {
    robot_.enter(percepts, commands);
    const Status status = run(percepts, commands);
    robot_.leave();
    // The host stops a robot whose program fails, and tells its error.
    if (!status) throw std::runtime_error(status.error().text());
  }

 private:
  Status load(const Params& params) {
    std::filesystem::path file(params.text("file"));
    if (file.is_relative()) file = folder_ / file;
    RAVE_TRY_ASSIGN(const std::string source, read_file(file, kMostSource));
    RAVE_TRY_ASSIGN(script::Value given, table_of(params.text("with")));
    script::Limits limits;
    limits.instructions = static_cast<std::uint64_t>(params.integer("instructions"));
    const script::Value params_before = robot_.params();
    robot_.set_params(std::move(given));
    auto script = load_script(source, file, limits);
    if (!script) {
      robot_.set_params(params_before);
      return tl::unexpected(std::move(script).error());
    }
    script_ = *std::move(script);
    folder_ = file.parent_path();
    return {};
  }

  Result<std::unique_ptr<script::Script>> load_script(const std::string& source,
                                                      const std::filesystem::path& file,
                                                      const script::Limits& limits) {
    const std::string name = file.filename().string();
    RAVE_TRY_ASSIGN(auto script, script::Script::load(source, name, robot_.functions(), limits));
    if (!script->defines("decide")) {
      return fail(ErrorCode::kNotFound, "{} defines no function `decide`", name);
    }
    if (script_ != nullptr) RAVE_TRY(script->set_memory(script_->memory()));
    return script;
  }

  /// The entries of a table as they stand between its braces.
  static Result<script::Value> table_of(std::string_view entries) {
    RAVE_TRY_ASSIGN(const auto reader, script::Script::load("", "with", {}));
    RAVE_TRY_ASSIGN(const std::size_t table,
                    reader->compile(fmt::format("{{{}\n}}", entries), {"with", 1, 1}));
    return reader->evaluate(table);
  }

  Status run(const Percepts& percepts, Commands& commands) {
    for (const Order order : percepts.orders()) {
      if (!script_->defines("on_order")) {
        commands.say("I take no orders: my program defines no on_order().");
        continue;
      }
      const script::Value value = order_value(order);
      RAVE_TRY(script_->call("on_order", std::span(&value, 1)));
    }
    RAVE_TRY(script_->call("decide", {}));
    return {};
  }

  LuaRobot robot_;
  std::filesystem::path folder_;
  std::unique_ptr<script::Script> script_;
};

}  // namespace
}  // namespace rave::lua

RAVE_PLUGIN("lua") {
  rave::add_program<rave::lua::LuaProgram>(
      registry, {.name = "lua",
                 .summary = "Decides as a Lua file says: a program that needs no compiler.",
                 .params = rave::lua::kParams});
}
