// SPDX-License-Identifier: Apache-2.0
#include "commands/keys.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_members(CLI::App& app, std::vector<std::string>& members) {
  add_word(app, "members", members, "Name of each process or machine", "MEMBER");
}

void add_folder(CLI::App& app, std::string& folder, const char* what) {
  add_word(app, "folder", folder, what, "DIR");
}

void add_new_keys(CLI::App& parent, Command& chosen) {
  const auto [app, c] =
      add_command(parent, chosen, "new", "Create a set of certificates", new_keys);
  add_folder(app, c.folder, "Folder to create");
  add_members(app, c.members);
  add_value(app, "--name", c.lab, "Name of the lab, part of all certificates [rave]", "LAB");
  add_value(app, "--days", c.days, "Days of validity [3650]", "N");
  app.footer(
      "Creates DIR/ca, the certificate authority, and a folder for each member. Copy each member\n"
      "folder to the machine that uses it. Keep DIR/ca secret. DIR/line.key signs tickets of "
      "direct\n"
      "lines, for `rave gui --line-key`; members have its public half.\n\n"
      "Example:\n"
      "  rave keys new lab-keys env left right\n"
      "  rave env lab --security lab-keys/env");
}

void add_add(CLI::App& parent, Command& chosen) {
  const auto [app, c] =
      add_command(parent, chosen, "add", "Add members to a set of certificates", add_keys);
  add_folder(app, c.folder, "Folder of the set, with its ca");
  add_members(app, c.members);
  add_value(app, "--days", c.days, "Days of validity [that of the ca]", "N");
  app.footer("Example:\n  rave keys add lab-keys gui");
}

void add_show(CLI::App& parent, Command& chosen) {
  const auto [app, c] = add_command(
      parent, chosen, "show", "Show the members of a set, their validity, and problems", show_keys);
  add_folder(app, c.folder, "Folder of a set or of one member");
  app.footer(
      "Exit code: 0 if all certificates are usable, 1 if not, 2 if there are none.\n\n"
      "Example:\n"
      "  rave keys show lab-keys");
}

void add_web(CLI::App& parent, Command& chosen) {
  const auto [app, c] =
      add_command(parent, chosen, "web", "Create the certificate of the web page (TLS)", web_keys);
  add_folder(app, c.folder, "Folder; an authority that exists there is used again");
  add_word(app, "names", c.names, "Host names and addresses of the page", "NAME");
  add_value(app, "--days", c.days, "Days of validity, at most 397 [397]", "N");
  app.footer(
      "The authority is limited to these names. It is independent of `rave keys new`.\n\n"
      "Example:\n"
      "  rave keys web web-keys lab.example 192.168.1.20\n"
      "  rave gui RUN --listen 192.168.1.20 --certificate web-keys/server.pem \\\n"
      "    --key web-keys/server_key.pem");
}

void add_line(CLI::App& parent, Command& chosen) {
  const auto [app, c] = add_command(
      parent, chosen, "line", "Create the key that a GUI Server signs tickets with", line_keys);
  add_word(app, "file", c.file, "For the GUI Server; FILE.pub is for hosts", "FILE");
  app.footer(
      "Example:\n"
      "  rave keys line lab-line\n"
      "  rave gui lab --line-key lab-line\n"
      "  rave robot lab --host left --web --web-key lab-line.pub");
}

}  // namespace

void add_keys_commands(CLI::App& root, Command& chosen) {
  CLI::App& parent =
      *root.add_subcommand("keys", "Create certificates for encrypted communication");
  parent.require_subcommand(1);
  parent.footer("Example:\n  rave keys new lab-keys env left right");
  add_new_keys(parent, chosen);
  add_add(parent, chosen);
  add_show(parent, chosen);
  add_web(parent, chosen);
  add_line(parent, chosen);
}

}  // namespace rave::cli
