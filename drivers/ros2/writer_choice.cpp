// SPDX-License-Identifier: Apache-2.0
#include "ros2/writer_choice.hpp"

#include <algorithm>

namespace rave::ros2_driver {
namespace {

std::string two_writers(std::string_view what, const ros2::RemoteId& first,
                        const ros2::RemoteId& second) {
  return fmt::format(
      "two writers of {}, {} and {}: only the first counts. Two robots with the "
      "same topics need a `namespace` each",
      what, text_of(first), text_of(second));
}

}  // namespace

WriterChoice::Ruling WriterChoice::judge(Ros2Device& device, const ros2::End& reader,
                                         dds_instance_handle_t writer, double patience_s,
                                         std::string_view frame) {
  const double now_s = line::host_seconds(line::host_now());
  if (writers_.present() == writer) {
    (void)writers_.take(writer, now_s, patience_s);
    return {true, false, ""};
  }
  const ros2::RemoteId id = reader.identify(writer).value_or(ros2::RemoteId{});
  bool gone = false;
  bool nearer = false;
  if (writers_.present()) {
    const auto matched = reader.matched();
    gone = std::ranges::find(matched, *writers_.present()) == matched.end();
    nearer = device.rank(id.participant) < device.rank(present_.participant);
  }
  const auto verdict = writers_.take(writer, now_s, patience_s, gone || nearer);
  if (!verdict.counts && !verdict.new_rival) return {};
  const std::string what = frame.empty() ? fmt::format("`{}`", reader.topic())
                                         : fmt::format("`{}` to `{}`", reader.topic(), frame);
  if (!verdict.counts) return {false, false, two_writers(what, present_, id)};
  Ruling ruling{true, verdict.changed, ""};
  if (nearer) {
    ruling.news = two_writers(what, id, present_);
  } else if (verdict.changed) {
    ruling.news = fmt::format("from now on {} is that of {}, since {} is {}", what, text_of(id),
                              text_of(present_), gone ? "gone" : "silent");
  }
  present_ = id;
  device.add_process(id.participant);
  return ruling;
}

}  // namespace rave::ros2_driver
