// SPDX-License-Identifier: Apache-2.0
#include "recorded_run.hpp"

#include "rave/control/order_words.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::runtime {

Result<std::vector<std::uint64_t>> read_hashes(const record::McapReader& reader) {
  std::vector<std::uint64_t> hashes;
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const record::StepHash hash, record::decode_hash(message.bytes));
    // By step without gaps; a duplicate of a merged recording is ignored.
    if (hash.step == hashes.size()) hashes.push_back(hash.hash);
    return {};
  };
  RAVE_TRY(record::for_each_message(reader, record::topic::kHash, take));
  return hashes;
}

Result<std::vector<record::RunInput>> read_inputs(const record::McapReader& reader) {
  std::vector<record::RunInput> inputs;
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(record::RunInput input, record::decode_input(message.bytes));
    inputs.push_back(std::move(input));
    return {};
  };
  RAVE_TRY(record::for_each_message(reader, record::topic::kInputs, take));
  return inputs;
}

Result<request::Request> request_of(const record::RunInput& input) {
  RAVE_TRY_ASSIGN(auto action, recorded_action({input.kind, input.key, input.value}));
  return request::Request{std::move(action), input.robot, input.by};
}

}  // namespace rave::runtime
