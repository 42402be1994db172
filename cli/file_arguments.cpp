// SPDX-License-Identifier: Apache-2.0
#include "commands/check.hpp"
#include "commands/describe.hpp"
#include "commands/drivers.hpp"
#include "commands/new.hpp"
#include "commands/schema.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_check(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "check",
                  "Check robot, world, scenario and experiment files, and draw them", check);
  add_word(app, "files", c.files, "Robot, world, scenario or experiment files; the keys tell which",
           "FILE");
  app.add_flag("--expand", c.expand, "Print the file with all defaults filled in");
  add_value(app, "--draw", c.draw,
            "Draw a robot with its sensors, or a world with the start poses of robots",
            "OUT.svg|OUT.png");
  add_settings(app, c.set);
  add_plugins(app, c.plugins);
  app.footer(
      "Exit code: 0 if all files are correct, 2 if not.\n\n"
      "Examples:\n"
      "  rave check robots/*.yaml\n"
      "  rave check robot.yaml --draw robot.svg\n"
      "  rave check scenario.yaml --expand > complete.yaml");
}

void add_drivers(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "drivers", "List available drivers and programs", drivers);
  add_value(app, "--kind", c.kind, "List one kind only, such as virtual_sensor or program", "KIND");
  auto* const json = app.add_flag("--json", c.json, "Print JSON");
  app.add_flag("--markdown-reference", c.markdown,
               "Print the complete reference as one Markdown page")
      ->excludes(json);
  add_plugins(app, c.plugins);
  app.footer(
      "Examples:\n"
      "  rave drivers --kind program\n"
      "  rave drivers --plugins my_driver/build");
}

void add_describe(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "describe",
                                    "Describe a driver or program and its parameters", describe);
  add_word(app, "driver", c.driver, "Name; `rave drivers` lists all", "DRIVER");
  auto* const json = app.add_flag("--json", c.json, "Print JSON");
  app.add_flag("--markdown", c.markdown, "Print a section of a Markdown page")->excludes(json);
  add_plugins(app, c.plugins);
  app.footer("Example:\n  rave describe virtual_laser");
}

void add_new(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(
      root, chosen, "new", "Create a project for a robot program, driver or panel", new_project);
  add_word(app, "kind", c.kind, "program, driver or panel", "KIND");
  add_word(app, "name", c.name, "Name, in lower_snake_case", "NAME");
  add_value(app, "--directory", c.directory, "Folder to create [NAME, in this folder]", "DIR");
  app.footer("Example:\n  rave new program follow_wall");
}

void add_schema(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "schema", "Print the JSON Schema of a kind of file", schema);
  add_word(app, "kind", c.kind, "robot, world, scenario or experiment", "KIND");
  app.footer("Example:\n  rave schema robot > robot.schema.json");
}

}  // namespace

void add_file_commands(CLI::App& root, Command& chosen) {
  add_check(root, chosen);
  add_drivers(root, chosen);
  add_describe(root, chosen);
  add_new(root, chosen);
  add_schema(root, chosen);
}

}  // namespace rave::cli
