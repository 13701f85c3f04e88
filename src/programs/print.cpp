#include "print.h"

#include <array>
#include <ostream>

#include "cli/number_text.h"
#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::programs {
namespace {

using cli::number_text;
using wire::has;

// The sentences below are worded by hand and have to name every field.
static_assert(wire::field_count<wire::CameraParams>() == 10 && wire::field_count<wire::Euler>() == 6 &&
              wire::field_count<wire::CameraConstants>() == 11);

void print_transform(std::ostream& out, const trkCameraParams& p) {
  if (has(p.format, trkEuler)) {
    out << "x " << number_text(p.t.e.x) << " y " << number_text(p.t.e.y) << " z " << number_text(p.t.e.z) << " m, pan "
        << number_text(p.t.e.pan) << " tilt " << number_text(p.t.e.tilt) << " roll " << number_text(p.t.e.roll)
        << " deg";
    return;
  }
  out << "matrix";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) out << (column == 0 ? " [" : " ") << number_text(p.t.m[column][row]);
    out << ']';
  }
}

}  // namespace

void print(std::ostream& out, const trkCameraConstants& c) {
  out << "constants: image " << c.imageWidth << " x " << c.imageHeight << " pixels, blank left " << c.blankLeft
      << " right " << c.blankRight << " top " << c.blankTop << " bottom " << c.blankBottom << ", chip "
      << number_text(c.chipWidth) << " x " << number_text(c.chipHeight) << " mm, fake chip "
      << number_text(c.fakeChipWidth) << " x " << number_text(c.fakeChipHeight) << " mm\n"
      << std::flush;
}

void print(std::ostream& out, const trkCameraParams& p) {
  std::array<char, trkStringSize> words{};
  if (trkFormatToString(p.format, words.data(), words.size()) != trkOK) words[0] = '\0';
  const bool is_angle = has(p.format, trkFieldOfView);
  out << "counter " << p.counter << ": " << words.data() << ": ";
  print_transform(out, p);
  out << (is_angle ? ", field of view " : ", image distance ") << number_text(p.fov) << (is_angle ? " deg" : " mm")
      << ", center shift " << number_text(p.centerX) << ' ' << number_text(p.centerY)
      << (has(p.format, trkShiftInPixels) ? " pixels" : " mm") << ", k1 " << number_text(p.k1) << " k2 "
      << number_text(p.k2) << ", focdist " << number_text(p.focdist) << " m, aperture " << number_text(p.aperture)
      << '\n'
      << std::flush;
}

}  // namespace trk_bridge::programs
