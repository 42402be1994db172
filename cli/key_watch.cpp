// SPDX-License-Identifier: Apache-2.0
#include "key_watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "rave/base/thread.hpp"
#include "terminal.hpp"

namespace rave::cli {
namespace {

::sigset_t ends() {
  ::sigset_t set{};
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGINT);
  ::sigaddset(&set, SIGTERM);
  ::sigaddset(&set, SIGQUIT);
  ::sigaddset(&set, SIGHUP);
  return set;
}

}  // namespace

KeyWatch::KeyWatch(bool keys) : keys_(keys && ::tcgetattr(STDIN_FILENO, &before_) == 0) {
  const ::sigset_t set = ends();
  // Blocked before the thread starts, which inherits it: a signal is then read and runs no handler.
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signals_ = Descriptor(::signalfd(-1, &set, SFD_CLOEXEC));
  if (keys_) {
    ::termios single = before_;
    single.c_lflag &= ~static_cast<::tcflag_t>(ICANON | ECHO);
    // Who stops the process would find the terminal as it is now.
    single.c_cc[VSUSP] = _POSIX_VDISABLE;
    ::tcsetattr(STDIN_FILENO, TCSANOW, &single);
  }
  const Status started = start_thread(thread_, "the keys", [this] { watch(); });
  if (started) return;
  give_back();
  put(stderr, fmt::format("{}; no keys are read, and Ctrl-C ends the process at once\n",
                          started.error().message));
}

void KeyWatch::give_back() const {
  if (keys_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  const ::sigset_t set = ends();
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

KeyWatch::~KeyWatch() {
  quit_.ring();
  if (thread_.joinable()) {
    thread_.join();
    give_back();
  }
}

std::stop_token KeyWatch::next() {
  const std::lock_guard lock(mutex_);
  // A token of its own for each wait, because one that was used stays so.
  if (!ended_) happened_ = std::stop_source();
  return happened_.get_token();
}

void KeyWatch::end_it() {
  ended_ = true;
  over_.request_stop();
}

void KeyWatch::wake() {
  const std::lock_guard lock(mutex_);
  happened_.request_stop();
}

void KeyWatch::take_key() {
  char key = 0;
  const ::ssize_t size = ::read(STDIN_FILENO, &key, 1);
  constexpr char kEndOfText = 4;
  if (size <= 0 || key == 'q' || key == 'Q' || key == kEndOfText) end_it();
  if (size > 0 && (key == 'r' || key == 'R')) toggled_ = true;
  wake();
}

void KeyWatch::watch() {
  while (!ended_) {
    std::array<::pollfd, 3> sources = {{{signals_.get(), POLLIN, 0},
                                        {quit_.descriptor(), POLLIN, 0},
                                        {keys_ ? STDIN_FILENO : -1, POLLIN, 0}}};
    if (::poll(sources.data(), sources.size(), -1) < 0) continue;
    if (sources[1].revents != 0) return;
    if (sources[0].revents != 0) {
      // Taken, or it would end the process as soon as it is let in again.
      ::signalfd_siginfo signal{};
      static_cast<void>(::read(signals_.get(), &signal, sizeof signal) > 0);
      end_it();
      wake();
    }
    if (sources[2].revents != 0) take_key();
  }
}

}  // namespace rave::cli
