// SPDX-License-Identifier: Apache-2.0
#include "hybrid_contact.hpp"

#include <algorithm>

namespace rave {

Status HybridContact::start(const HybridSetup& setup) {
  capacity_ = setup.real->capacity;
  return {};
}

void HybridContact::fuse(const FuseItem& item) const {
  const auto* const real = static_cast<const ContactReading*>(item.real_records);
  const auto* const imagined = static_cast<const ContactReading*>(item.imagined_records);
  auto* const result = static_cast<ContactReading*>(item.result_records);
  std::uint32_t count = item.real->count;
  std::copy(real, real + count, result);
  for (std::uint32_t i = 0; i < item.imagined->count; ++i) {
    // If the real half has no reading (drop-out), the virtual one counts alone.
    if (item.real->count == 0 && count < capacity_) {
      result[count++] = imagined[i];
      continue;
    }
    // "Not touching" of the virtual half adds nothing to what the real half says.
    if (imagined[i].touching == 0) continue;
    // A virtual touch replaces a record that says nothing, so the number of records stays that of
    // the bumper.
    ContactReading* const free =
        std::find_if(result, result + count,
                     [](const ContactReading& reading) { return reading.touching == 0; });
    if (free != result + count) {
      *free = imagined[i];
    } else if (count < capacity_) {
      result[count++] = imagined[i];
    }
  }
  item.result->count = count;
}

}  // namespace rave
