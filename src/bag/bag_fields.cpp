#include "bag_fields.h"

#include <array>
#include <cstdio>
#include <ostream>

namespace trk_bridge::bag {

void Omissions::add(const std::string& reason, std::int64_t stamp) {
  for (auto& known : reasons_) {
    if (known.text != reason) continue;
    ++known.times;
    return;
  }
  reasons_.push_back({reason, 1, stamp});
}

void Omissions::tell(std::ostream& err) const {
  for (const auto& reason : reasons_) {
    err << "trk: left out: " << reason.times << " fields, the first at " << stamp_text(reason.first) << ": "
        << reason.text << '\n';
  }
}

std::string stamp_text(std::int64_t nanoseconds) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%lld.%09lld", static_cast<long long>(nanoseconds / 1'000'000'000),
                static_cast<long long>(nanoseconds % 1'000'000'000));
  return text.data();
}

void BagConstants::take(const wire::CameraConstants& constants, std::int64_t stamp) {
  if (in_use_ && !(constants == *known_)) {
    throw BagError("the constants change at " + stamp_text(stamp) +
                   ", and a take holds one set: cut the recording there (rosbag filter)");
  }
  known_ = constants;
}

}  // namespace trk_bridge::bag
