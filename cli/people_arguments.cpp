// SPDX-License-Identifier: Apache-2.0
#include "people_arguments.hpp"

#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

CLI::App& add_one(CLI::App& parent, const char* name, const char* what, PeopleCommand& c) {
  CLI::App& app = *parent.add_subcommand(name, what);
  add_value(app, "--accounts", c.folder, "Folder of the accounts [that of the user]", "DIR");
  return app;
}

void add_person(CLI::App& app, PeopleCommand& c) {
  add_value(app, "--role", c.role, "observer, commander or super_user [observer]", "ROLE");
  add_value(app, "--teams", c.teams, "Such as green,blue; *: all, -: none [*]", "TEAMS");
}

}  // namespace

void add_people(CLI::App& root, PeopleCommand& command) {
  CLI::App& parent = *root.add_subcommand("people", "Say who may watch over the network");
  parent.require_subcommand(1);
  CLI::App& add = add_one(parent, "add", "Make an account; asks for its password", command);
  add_word(add, "name", command.name, "Who", "NAME");
  add_person(add, command);
  CLI::App& invite = add_one(parent, "invite", "Print a link with which others join", command);
  add_person(invite, command);
  add_value(invite, "--uses", command.uses, "For how many people [1]", "N");
  add_value(invite, "--days", command.days, "How long it is good [7]", "N");
  add_one(parent, "list", "Say who has an account, and which links are out", command);
  CLI::App& remove = add_one(parent, "remove", "Take an account back, and who is in out", command);
  add_word(remove, "name", command.name, "Who", "NAME");
  add_one(parent, "uninvite", "Take back all links", command);
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
