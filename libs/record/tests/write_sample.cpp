// SPDX-License-Identifier: Apache-2.0
// Writes the record of the sample run, for readers that are not ours. Usage: write_sample FILE
// STEPS
#include <cstdio>
#include <cstdlib>

#include "sample_run.hpp"

int main(int argc, char** argv) {
  using namespace rave::record;
  if (argc != 3) return 2;
  RunRecorderOptions options;
  options.file.chunk_bytes = 1 << 14;
  options.file.flush_interval_s = 1000;
  auto recorder = RunRecorder::open(argv[1], sample_info(), options);
  if (!recorder) {
    std::fprintf(stderr, "%s\n", recorder.error().text().c_str());
    return 1;
  }
  record_sample(*recorder, std::strtoull(argv[2], nullptr, 10));
  return recorder->end(0x0123456789abcdefULL) ? 0 : 1;
}
