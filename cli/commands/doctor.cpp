// SPDX-License-Identifier: Apache-2.0
#include "commands/doctor.hpp"

#include <fmt/format.h>

#include "error_text.hpp"
#include "key_watch.hpp"
#include "rave/bus/bus.hpp"
#include "rave/doctor/checks.hpp"
#include "rave/doctor/examine.hpp"
#include "rave/doctor/listener.hpp"
#include "rave/host/host_run.hpp"

namespace rave::cli {
namespace {

using doctor::Finding;
using doctor::Verdict;

std::string mark_of(Verdict verdict, const Terminal& terminal) {
  switch (verdict) {
    case Verdict::kGood:
      return terminal.green("good   ");
    case Verdict::kUnknown:
      return terminal.faint("unknown");
    case Verdict::kAdvice:
      return terminal.yellow("advice ");
    case Verdict::kProblem:
      break;
  }
  return terminal.red("PROBLEM");
}

void print(const doctor::Findings& findings) {
  const Terminal terminal = terminal_of(stdout);
  std::size_t problems = 0;
  std::string text;
  for (const Finding& finding : findings) {
    text += fmt::format("{}  {:<10} {}\n", mark_of(finding.verdict, terminal), finding.check,
                        finding.what);
    if (!finding.mend.empty()) text += fmt::format("         {:<10} {}\n", "", finding.mend);
    problems += finding.verdict == Verdict::kProblem ? 1U : 0U;
  }
  text += problems == 0 ? std::string("no problem found\n")
                        : fmt::format("{} problem{}; the line below each one says how to fix it\n",
                                      problems, problems == 1 ? "" : "s");
  put(stdout, text);
}

/// A listener is found by the machine that asks, so it needs no peers of its own.
bus::BusConfig listening(bus::BusConfig config, const std::string& address) {
  config.anonymous = true;
  if (config.multicast == bus::Multicast::kNone) config.peers.push_back(address);
  return config;
}

Result<int> listen(const bus::BusConfig& config, doctor::About about) {
  const doctor::Machine machine = doctor::this_machine();
  const doctor::Interface* const interface = machine.find(config.interface);
  if (interface == nullptr || interface->address.empty()) {
    return fail(ErrorCode::kNotFound, "{}", doctor::check_interface(machine, config).what);
  }
  KeyWatch keys(false);
  // Joined before it answers: who gets an answer looks for it on the bus.
  about.participant = config.participant;
  RAVE_TRY_ASSIGN(const auto bus, bus::Bus::open(listening(config, interface->address)));
  RAVE_TRY_ASSIGN(auto listener, doctor::Listener::open({interface->address, std::move(about)}));
  put(stderr, fmt::format("listening at {}, domain {}, until Ctrl-C; run on the other machine:\n"
                          "  rave doctor --domain {} --interface ITS_ADDRESS --peer {}\n",
                          interface->address, config.domain, config.domain, interface->address));
  listener->serve([&keys] { return keys.ended(); },
                  [](const std::string& who) { put(stderr, who + " asks\n"); });
  return kGood;
}

}  // namespace

Result<int> doctor(const DoctorCommand& options) {
  const std::string name = fmt::format("rave doctor {:.8}", bus::RunId::random().text());
  RAVE_TRY_ASSIGN(auto config, read_bus_options(options.bus, name, 0));
  // Room for every host: the doctor must find what a run would find.
  make_room(config, kMostHosts);
  const doctor::About here = doctor::about_here(config, runtime::interface_stamp());
  if (options.listen) return listen(config, here);
  const doctor::Findings findings = doctor::examine(doctor::this_machine(), config, here);
  if (options.json) {
    put(stdout, doctor::to_json(findings));
  } else {
    print(findings);
  }
  return doctor::all_well(findings) ? kGood : kNotGood;
}

}  // namespace rave::cli
