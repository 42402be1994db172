// SPDX-License-Identifier: Apache-2.0
#include "commands/people.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

Subcommand<PeopleCommand> add_one(CLI::App& parent, Command& chosen, const char* name,
                                  const char* what, PeopleCommand::What change) {
  const auto added = add_command(parent, chosen, name, what, people);
  added.options.what = change;
  add_value(added.app, "--accounts", added.options.folder,
            "Folder of the accounts [one per system user]", "DIR");
  return added;
}

void add_person(CLI::App& app, PeopleCommand& c) {
  add_value(app, "--role", c.role, "Role: observer, commander or super_user [observer]", "ROLE");
  add_value(app, "--teams", c.teams, "Teams, such as green,blue; * is all, - is none [*]", "TEAMS");
}

}  // namespace

void add_people_commands(CLI::App& root, Command& chosen) {
  using What = PeopleCommand::What;
  CLI::App& parent = *root.add_subcommand(
      "people", "Manage accounts of people who open the page over the network");
  parent.require_subcommand(1);
  const auto add =
      add_one(parent, chosen, "add", "Add an account; asks for the password", What::kAdd);
  add_word(add.app, "name", add.options.name, "Name of the account", "NAME");
  add_person(add.app, add.options);
  const auto [invite, c] =
      add_one(parent, chosen, "invite", "Create an invitation and print its link", What::kInvite);
  add_value(invite, "--name", c.name,
            "Name of the one person whom it is for; no other person gets it [each chooses one]",
            "NAME");
  add_person(invite, c);
  add_value(invite, "--uses", c.uses, "Number of people who can use the link [1]", "N");
  add_value(invite, "--days", c.days, "Days of validity [7]", "N");
  add_one(parent, chosen, "list", "List accounts and open invitations", What::kList);
  const auto remove =
      add_one(parent, chosen, "remove", "Remove an account and end its sessions", What::kRemove);
  add_word(remove.app, "name", remove.options.name, "Name of the account", "NAME");
  add_one(parent, chosen, "uninvite", "Withdraw all invitations", What::kUninvite);
  parent.footer(
      "Examples:\n"
      "  rave people add ada --role super_user\n"
      "  rave people invite --role observer --teams green --uses 20\n"
      "  rave people invite --name ben --role commander");
}

}  // namespace rave::cli
