// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/bus_options.hpp"
#include "rave/control/bus_run.hpp"
#include "rave/control/protocol.hpp"

namespace rave::client {

/// A run on the bus, or one host of a run that has no manager, as `rave ps` lists it.
struct SeenRun {
  std::string name;      ///< Name for use in commands.
  std::string machines;  ///< Machines of its processes; empty if none answered.
  Result<runtime::RunStatus> status;
};

/// The answer of one of several processes.
struct Reply {
  std::string name;  ///< For people.
  Result<control::Answer> answer;
};

/// A process of a run that receives requests: over its socket if it belongs to this user on this
/// machine, otherwise over the bus. One owner thread.
class AskedRun {
 public:
  /// The process of a run on this machine, by the name of its socket.
  explicit AskedRun(std::string local) : name_(std::move(local)) {}

  /// The process that a word refers to: on this machine, as of control::find_run(). If no process
  /// there matches, on the bus: the run, and after an `@` its host, otherwise its environment
  /// manager. Errors: kNotFound with the available runs, those of bus::Bus::open().
  [[nodiscard]] static Result<AskedRun> find(const std::string& word,
                                             const bus::BusOptions& options);

  /// The process of a run on the bus for whose status `has` is true; its environment manager if all
  /// have answered and it is true for none. Errors: those of find(); kNotFound (several match); if
  /// none matches, those of status() of a process that did not answer.
  using Has = std::function<bool(const runtime::RunStatus&)>;
  [[nodiscard]] static Result<AskedRun> find_on_bus(const std::string& word,
                                                    const bus::BusOptions& options, const Has& has);

  /// Sends a request to every process on the bus that a word can refer to: of each matching run, or
  /// of all runs if it is empty, the host after the `@`, otherwise the environment manager in
  /// lock-step, and all hosts. Each is asked as soon as it is found, before it is certain that the
  /// word is unambiguous. So the request must do no harm to another run, as a stop. Empty: no
  /// process was found. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::vector<Reply>> ask_each_on_bus(const std::string& word,
                                                                  const bus::BusOptions& options,
                                                                  const control::Request& request);

  /// The processes that stop and arm the robots of this run: itself, or for the manager of a run in
  /// real time the hosts, only those of this machine if it was found here. With several runs of a
  /// scenario here, hosts cannot be attributed to a run: error kNotFound if `sure` is set,
  /// otherwise the hosts of all.
  [[nodiscard]] Result<std::vector<AskedRun>> controllers(bool sure) const;

  /// The processes that take orders of people: itself, or the hosts of a run of several processes,
  /// in lock-step too. Only the one that has `robot`, if one says so.
  [[nodiscard]] std::vector<AskedRun> takers_of_orders(const std::string& robot) const;

  /// The processes to be asked to end a run: the only one, its environment manager, or its hosts if
  /// the manager has left. A run on this machine as of control::find_run(); else on the bus; else
  /// hosts on this machine of the scenario with that name. Errors: those of find().
  [[nodiscard]] static Result<std::vector<AskedRun>> find_to_end(const std::string& word,
                                                                 const bus::BusOptions& options);

  /// The runs on the bus with their status, also those of this machine. Searches for 1.5 s, or 3 s
  /// beyond loopback, and asks one after the other. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::vector<SeenRun>> all_on_bus(const bus::BusOptions& options);

  /// Whether a run on this machine matches; then runs on the bus are not considered.
  [[nodiscard]] static bool may_be_here(const std::string& word);

  /// For people.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] bool on_bus() const noexcept { return bus_ != nullptr; }

  /// `patience` is for answers over the bus. Errors: those of control::ask() or
  /// control::BusRun::ask().
  [[nodiscard]] Result<control::Answer> ask(const control::Request& request,
                                            Duration patience = control::BusRun::kPatience) const;
  /// Errors: those of ask(); kState (refused, for example because of too many requests, or the
  /// status is larger than the bus carries).
  [[nodiscard]] Result<runtime::RunStatus> status(
      Duration patience = control::BusRun::kPatience) const;

 private:
  /// Whether it is one host of several.
  [[nodiscard]] bool is_host() const;
  /// The hosts of its run, as far as they are heard; those of this machine if it was found here.
  [[nodiscard]] std::vector<AskedRun> hosts() const;
  AskedRun(std::string name, std::shared_ptr<control::BusRun> bus, control::BusPeer peer)
      : name_(std::move(name)), bus_(std::move(bus)), peer_(std::move(peer)) {}

  std::string name_;
  /// Shared by the processes of one run. Null: on this machine.
  std::shared_ptr<control::BusRun> bus_;
  control::BusPeer peer_;
};

/// Completes the status of a manager in real time with what a host of its run says of its robots.
void complete(runtime::RunStatus& manager, const runtime::RunStatus& host);

}  // namespace rave::client
