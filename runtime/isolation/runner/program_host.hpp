// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "layout.hpp"
#include "log_sender.hpp"
#include "order_bytes.hpp"
#include "program_file.hpp"
#include "rave/base/result.hpp"
#include "rave/robot/program.hpp"
#include "setup_copy.hpp"
#include "shared_memory.hpp"

namespace rave::isolation {

/// Frees memory that was allocated with the aligned operator new.
struct FreeAligned {
  std::align_val_t alignment{1};
  void operator()(void* memory) const noexcept { ::operator delete(memory, alignment); }
};

/// Runs one program in its own process: takes percepts from the shared memory and answers the host
/// until that closes the socket.
class ProgramHost {
 public:
  /// Reads from `memory` which program to run. Errors: kParse.
  [[nodiscard]] static Result<std::unique_ptr<ProgramHost>> create(SharedMemory memory, int socket);
  ~ProgramHost();
  ProgramHost(const ProgramHost&) = delete;
  ProgramHost& operator=(const ProgramHost&) = delete;

  [[nodiscard]] const Order& order() const noexcept { return setup_->order(); }
  /// Loads, constructs and starts the program, and reports the result to the host.
  Status start();
  /// Serves the host until it is gone or a decision fails.
  void serve();

 private:
  ProgramHost(SharedMemory memory, std::unique_ptr<SetupCopy> setup, int socket);

  Status load_and_start();
  bool decide(std::uint32_t decision);
  /// The current view of one direction of a communicator in the shared memory.
  [[nodiscard]] Mailbox mailbox(const Layout::Box& box) const;
  /// Offers new parameters to the program; false if the connection cannot continue.
  bool update(std::string_view bytes);

  int socket_;
  SharedMemory memory_;
  std::unique_ptr<SetupCopy> setup_;
  Layout layout_;
  LogSender log_;
  std::unique_ptr<ProgramFile> file_;
  std::vector<SensorView> views_;
  std::vector<Mailbox> boxes_;  ///< The incoming and outgoing mailboxes of each communicator.
  std::vector<CommunicatorView> communicators_;
  std::vector<OrderItem> orders_;
  std::unique_ptr<AnswerWriter> answers_;
  std::unique_ptr<void, FreeAligned> instance_;
  bool constructed_ = false;
};

}  // namespace rave::isolation
