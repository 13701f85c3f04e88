// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "fields.h"

#include <ostream>

#include "base/time_text.h"

namespace trk_bridge::bag {

void RecordedConstants::use(const wire::CameraConstants& constants, std::int64_t stamp) {
  switch (converter_.use(constants)) {
    case camera::ConstantsChange::unchanged:
      return;
    case camera::ConstantsChange::changed:
      if (!is_fixed_) return;
      throw BagError("the constants change at " + base::seconds_text(stamp) +
                     ", and a take holds one set: cut the recording there (rosbag filter)");
    case camera::ConstantsChange::invalid:
      throw BagError("the constants at " + base::seconds_text(stamp) + ": " +
                     camera::describe(camera::CameraReason::bad_constants));
  }
}

void refuse_chip_options() {
  throw BagError("--chip-width, --chip-height: for bags without constants; this one has them");
}

void Omissions::add(const std::string& reason, std::int64_t stamp) {
  for (auto& known : reasons_) {
    if (known.text != reason) continue;
    ++known.times;
    return;
  }
  reasons_.push_back({reason, 1, stamp});
}

void Omissions::report(std::ostream& err) const {
  for (const auto& reason : reasons_) {
    err << "trk: omitted: " << reason.times << " fields, the first at " << base::seconds_text(reason.first) << ": "
        << reason.text << '\n';
  }
}

}  // namespace trk_bridge::bag
