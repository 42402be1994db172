// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/lines.hpp"

namespace rave::direct_line {
namespace {

class LinesHere final : public Lines {
 public:
  LinesHere(LineServer& server, std::string run, HostLine line)
      : server_(server), run_(std::move(run)), line_(std::move(line)) {}

  [[nodiscard]] std::string run() const override { return run_; }
  [[nodiscard]] std::vector<HostLine> hosts() const override { return {line_}; }
  void withdraw(const std::string& /*user*/, const std::string& signed_text) override {
    server_.withdraw(signed_text);
  }

 private:
  LineServer& server_;
  std::string run_;
  HostLine line_;
};

}  // namespace

std::unique_ptr<Lines> lines_here(LineServer& server, std::string run, HostLine line) {
  return std::make_unique<LinesHere>(server, std::move(run), std::move(line));
}

}  // namespace rave::direct_line
