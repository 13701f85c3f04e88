#include "environment.h"

#include <cstdio>
#include <cstdlib>

namespace trk_bridge::c_api {

std::optional<wire::LayoutChoice> layout_from_environment() {
  const char* const word = std::getenv("TRK_LAYOUT");
  if (word == nullptr) return wire::LayoutChoice{};
  const auto choice = wire::layout_choice_from_word(word);
  if (!choice) {
    std::fprintf(stderr,
                 "libtrk: TRK_LAYOUT=%s: allowed are auto, document and identified, the latter two also followed by "
                 "_lp64, _llp64 or _i386 and that by _le or _be\n",
                 word);
  }
  return choice;
}

}  // namespace trk_bridge::c_api
