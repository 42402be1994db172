// SPDX-License-Identifier: Apache-2.0
#include "people_arguments.hpp"

#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

CLI::App& add_one(CLI::App& parent, const char* name, const char* what, PeopleCommand& c) {
  CLI::App& app = *parent.add_subcommand(name, what);
  add_value(app, "--accounts", c.folder, "Folder of the accounts [one per system user]", "DIR");
  return app;
}

void add_person(CLI::App& app, PeopleCommand& c) {
  add_value(app, "--role", c.role, "Role: observer, commander or super_user [observer]", "ROLE");
  add_value(app, "--teams", c.teams, "Teams, such as green,blue; * is all, - is none [*]", "TEAMS");
}

}  // namespace

void add_people(CLI::App& root, PeopleCommand& command) {
  CLI::App& parent = *root.add_subcommand(
      "people", "Manage accounts of people who open the page over the network");
  parent.require_subcommand(1);
  CLI::App& add = add_one(parent, "add", "Add an account; asks for the password", command);
  add_word(add, "name", command.name, "Name of the account", "NAME");
  add_person(add, command);
  CLI::App& invite = add_one(parent, "invite", "Create an invitation and print its link", command);
  add_person(invite, command);
  add_value(invite, "--uses", command.uses, "Number of people who can use the link [1]", "N");
  add_value(invite, "--days", command.days, "Days of validity [7]", "N");
  add_one(parent, "list", "List accounts and open invitations", command);
  CLI::App& remove = add_one(parent, "remove", "Remove an account and end its sessions", command);
  add_word(remove, "name", command.name, "Name of the account", "NAME");
  add_one(parent, "uninvite", "Withdraw all invitations", command);
  parent.footer(
      "Examples:\n"
      "  rave people add ada --role super_user\n"
      "  rave people invite --role observer --teams green --uses 20");
}

PeopleCommand chosen_people(const std::string& name, PeopleCommand command) {
  using What = PeopleCommand::What;
  command.what = name == "add"        ? What::kAdd
                 : name == "invite"   ? What::kInvite
                 : name == "remove"   ? What::kRemove
                 : name == "uninvite" ? What::kUninvite
                                      : What::kList;
  return command;
}

}  // namespace rave::cli
