// SPDX-License-Identifier: Apache-2.0
#include "file_arguments.hpp"

#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_check(CLI::App& root, CheckCommand& c) {
  CLI::App& app =
      *root.add_subcommand("check", "Check robot, world and scenario files, and draw them");
  add_word(app, "files", c.files, "Which of the three a file is, is seen by its keys", "FILE");
  app.add_flag("--expand", c.expand, "Print the file with all defaults");
  add_value(app, "--draw", c.draw,
            "Draw a robot with its sensors, or a world with the robots at their start",
            "OUT.svg|OUT.png");
  add_plugins(app, c.plugins);
  app.footer(
      "Exit code: 0 if all files are right, 2 if not.\n\n"
      "Examples:\n"
      "  rave check robots/*.yaml\n"
      "  rave check robot.yaml --draw robot.svg\n"
      "  rave check scenario.yaml --expand > complete.yaml");
}

void add_drivers(CLI::App& root, DriversCommand& c) {
  CLI::App& app = *root.add_subcommand("drivers", "List the drivers and programs there are");
  add_value(app, "--kind", c.kind, "Only one kind, such as virtual_sensor or program", "KIND");
  auto* const json = app.add_flag("--json", c.json, "For other programs");
  app.add_flag("--markdown-reference", c.markdown, "The whole reference as one page")
      ->excludes(json);
  add_plugins(app, c.plugins);
  app.footer(
      "Examples:\n"
      "  rave drivers --kind program\n"
      "  rave drivers --plugins my_driver/build");
}

void add_describe(CLI::App& root, DescribeCommand& c) {
  CLI::App& app = *root.add_subcommand("describe", "Say what a driver or program is and takes");
  add_word(app, "driver", c.driver, "Its name; `rave drivers` lists them", "DRIVER");
  auto* const json = app.add_flag("--json", c.json, "For other programs");
  app.add_flag("--markdown", c.markdown, "As a section of a page")->excludes(json);
  add_plugins(app, c.plugins);
  app.footer("Example:\n  rave describe virtual_laser");
}

void add_new(CLI::App& root, NewCommand& c) {
  CLI::App& app = *root.add_subcommand("new", "Begin a robot program, driver or panel of your own");
  add_word(app, "kind", c.kind, "program, driver or panel", "KIND");
  add_word(app, "name", c.name, "In lower_snake_case", "NAME");
  add_value(app, "--directory", c.directory, "Where [NAME in this folder]", "DIR");
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
