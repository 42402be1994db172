// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus_options.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/control/bus_run.hpp"
#include "rave/control/protocol.hpp"

namespace rave::cli {

/// A run on the bus, or one host of a run that has no manager, as `rave ps` lists it.
struct SeenRun {
  std::string name;      ///< What a command takes for it.
  std::string machines;  ///< Where its processes are; empty if none is heard.
  Result<runtime::RunStatus> status;
};

/// What came of a request to one of several processes.
struct Reply {
  std::string name;  ///< For people.
  Result<control::Answer> answer;
};

/// A process of a run that is asked something: of this user on this machine, over its socket, or
/// else wherever it is, over the bus. One owner thread.
class AskedRun {
 public:
  /// That of a run on this machine, by the name of its socket.
  explicit AskedRun(std::string local) : name_(std::move(local)) {}

  /// The one that a word stands for: on this machine, as of control::find_run(); if nothing
  /// there can be meant, on the bus: the run, and behind an `@` the host of it, else its
  /// environment manager. Errors: kNotFound with what there is, those of bus::Bus::open().
  [[nodiscard]] static Result<AskedRun> find(const std::string& word, const BusOptions& options);

  /// Of a run on the bus, the process whose status has what is looked for; its environment manager
  /// if all have answered and none has. Errors: those of find(); kNotFound (several have it); if
  /// none has it, those of status() of one that did not answer.
  using Has = std::function<bool(const runtime::RunStatus&)>;
  [[nodiscard]] static Result<AskedRun> find_on_bus(const std::string& word,
                                                    const BusOptions& options, const Has& has);

  /// Asks every process on the bus that a word can mean: of each run that it can stand for, or of
  /// all runs if it is empty, the host behind the `@`, else the environment manager in lock-step,
  /// and all hosts. Each is asked as soon as it is found, and not after it is sure that no other
  /// can be meant; what is done to one too many must do no harm, as a stop. Empty: nobody was
  /// found. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::vector<Reply>> ask_each_on_bus(const std::string& word,
                                                                  const BusOptions& options,
                                                                  const control::Request& request);

  /// The processes that stop and arm the robots of this run: itself, or if it is the manager of a
  /// run in real time the hosts, those of this machine if it was found here. Of several runs of a
  /// scenario here it cannot be told whose hosts are whose: error kNotFound if that has to be
  /// `sure`, else those of all.
  [[nodiscard]] Result<std::vector<AskedRun>> controllers(bool sure) const;

  /// The processes that take orders of people: itself, or of a run of several processes its hosts,
  /// in lock-step too. Of these only the one that has the robot, if one says so.
  [[nodiscard]] std::vector<AskedRun> takers_of_orders(const std::string& robot) const;

  /// Those that have to be asked to end a run: the one that does it alone, its environment manager,
  /// or where that is gone its hosts. A run on this machine as of control::find_run(); else on
  /// the bus; else hosts on this machine of the scenario that the word is. Errors: those of find().
  [[nodiscard]] static Result<std::vector<AskedRun>> find_to_end(const std::string& word,
                                                                 const BusOptions& options);

  /// The runs on the bus, each asked how it stands; those of this machine are among them. Looks for
  /// 1.5 s, or 3 s beyond loopback, and asks one after the other. Errors: those of
  /// bus::Bus::open().
  [[nodiscard]] static Result<std::vector<SeenRun>> all_on_bus(const BusOptions& options);

  /// Whether a run on this machine can be meant, which then counts before any on the bus.
  [[nodiscard]] static bool may_be_here(const std::string& word);

  /// For people.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] bool on_bus() const noexcept { return bus_ != nullptr; }

  /// `patience` is for answers over the bus. Errors: those of control::ask() or
  /// control::BusRun::ask().
  [[nodiscard]] Result<control::Answer> ask(const control::Request& request,
                                            Duration patience = control::BusRun::kPatience) const;
  /// Errors: those of ask(); kState (it was refused, as one that asks too often is, or the status
  /// is larger than the bus carries).
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

}  // namespace rave::cli
