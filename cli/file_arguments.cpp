// SPDX-License-Identifier: Apache-2.0
#include "file_arguments.hpp"

#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_check(CLI::App& root, CheckCommand& c) {
  CLI::App& app =
      *root.add_subcommand("check", "Check robot, world and scenario files, and draw them");
  add_word(app, "files", c.files, "Robot, world or scenario files; the keys tell which", "FILE");
  app.add_flag("--expand", c.expand, "Print the file with all defaults filled in");
  add_value(app, "--draw", c.draw,
            "Draw a robot with its sensors, or a world with the start poses of robots",
            "OUT.svg|OUT.png");
  add_plugins(app, c.plugins);
  app.footer(
      "Exit code: 0 if all files are correct, 2 if not.\n\n"
      "Examples:\n"
      "  rave check robots/*.yaml\n"
      "  rave check robot.yaml --draw robot.svg\n"
      "  rave check scenario.yaml --expand > complete.yaml");
}

void add_drivers(CLI::App& root, DriversCommand& c) {
  CLI::App& app = *root.add_subcommand("drivers", "List available drivers and programs");
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

void add_describe(CLI::App& root, DescribeCommand& c) {
  CLI::App& app =
      *root.add_subcommand("describe", "Describe a driver or program and its parameters");
  add_word(app, "driver", c.driver, "Name; `rave drivers` lists all", "DRIVER");
  auto* const json = app.add_flag("--json", c.json, "Print JSON");
  app.add_flag("--markdown", c.markdown, "Print a section of a Markdown page")->excludes(json);
  add_plugins(app, c.plugins);
  app.footer("Example:\n  rave describe virtual_laser");
}

void add_new(CLI::App& root, NewCommand& c) {
  CLI::App& app =
      *root.add_subcommand("new", "Create a project for a robot program, driver or panel");
  add_word(app, "kind", c.kind, "program, driver or panel", "KIND");
  add_word(app, "name", c.name, "Name, in lower_snake_case", "NAME");
  add_value(app, "--directory", c.directory, "Folder to create [NAME, in this folder]", "DIR");
  app.footer("Example:\n  rave new program follow_wall");
}

void add_schema(CLI::App& root, SchemaCommand& c) {
  CLI::App& app = *root.add_subcommand("schema", "Print the JSON Schema of a kind of file");
  add_word(app, "kind", c.kind, "robot, world or scenario", "KIND");
  app.footer("Example:\n  rave schema robot > robot.schema.json");
}

}  // namespace

void add_file_commands(CLI::App& root, FileCommands& commands) {
  add_check(root, commands.check);
  add_drivers(root, commands.drivers);
  add_describe(root, commands.describe);
  add_new(root, commands.make);
  add_schema(root, commands.schema);
}

}  // namespace rave::cli
