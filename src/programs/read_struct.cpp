#include "read_struct.h"

#include <array>
#include <charconv>
#include <chrono>
#include <iostream>

#include "pacing.h"
#include "cli/stop_signals.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::programs {
namespace {

constexpr int seconds_to_run = 30;

/// A number in `out` at its shortest.
struct Shortest {
  double value;
};

std::ostream& operator<<(std::ostream& out, Shortest number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number.value).ptr;
  return out.write(text.data(), end - text.data());
}

// The sentences below are worded by hand and have to name every field.
static_assert(wire::field_count<wire::CameraParams>() == 10 && wire::field_count<wire::Euler>() == 6 &&
              wire::field_count<wire::CameraConstants>() == 11);

bool has(unsigned format, unsigned option) { return (format & option) != 0; }

void print_transform(std::ostream& out, const trkCameraParams& p) {
  if (has(p.format, trkEuler)) {
    out << "x " << Shortest{p.t.e.x} << " y " << Shortest{p.t.e.y} << " z " << Shortest{p.t.e.z} << " m, pan "
        << Shortest{p.t.e.pan} << " tilt " << Shortest{p.t.e.tilt} << " roll " << Shortest{p.t.e.roll} << " deg";
    return;
  }
  out << "matrix";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) out << (column == 0 ? " [" : " ") << Shortest{p.t.m[column][row]};
    out << ']';
  }
}

/// True when there was something; `failed` is set when the transfer has to end.
template <typename Record>
bool read_and_print(const std::function<trkError(Record*)>& read, bool& failed) {
  Record record{};
  const trkError error = read(&record);
  if (error == trkOK) {
    print(std::cout, record);
    return true;
  }
  if (error == trkUnavailable) return false;
  std::cerr << trkErrorMessage(error) << '\n';
  failed = error != trkInvalidVersion;
  return false;
}

}  // namespace

void print(std::ostream& out, const trkCameraConstants& c) {
  out << "constants: image " << c.imageWidth << " x " << c.imageHeight << " pixels, blank left " << c.blankLeft
      << " right " << c.blankRight << " top " << c.blankTop << " bottom " << c.blankBottom << ", chip "
      << Shortest{c.chipWidth} << " x " << Shortest{c.chipHeight} << " mm, fake chip " << Shortest{c.fakeChipWidth}
      << " x " << Shortest{c.fakeChipHeight} << " mm\n"
      << std::flush;
}

void print(std::ostream& out, const trkCameraParams& p) {
  std::array<char, trkStringSize> words{};
  if (trkFormatToString(p.format, words.data(), words.size()) != trkOK) words[0] = '\0';
  const bool angle = has(p.format, trkFieldOfView);
  out << "counter " << p.counter << ": " << words.data() << ": ";
  print_transform(out, p);
  out << (angle ? ", field of view " : ", image distance ") << Shortest{p.fov} << (angle ? " deg" : " mm")
      << ", center shift " << Shortest{p.centerX} << ' ' << Shortest{p.centerY}
      << (has(p.format, trkShiftInPixels) ? " pixels" : " mm") << ", k1 " << Shortest{p.k1} << " k2 " << Shortest{p.k2}
      << ", focdist " << Shortest{p.focdist} << " m, aperture " << Shortest{p.aperture} << '\n'
      << std::flush;
}

cli::ExitCode poll_and_print(const Reader& reader) {
  const cli::StopSignals signals;
  Pacing pacing{std::chrono::seconds(1)};
  for (int second = 0; second <= seconds_to_run; ++second) {
    bool failed = false;
    read_and_print(reader.constants, failed);
    if (!failed) read_and_print(reader.params, failed);
    if (failed || !std::cout) return cli::exit_failed;
    if (second < seconds_to_run && !pacing.wait()) return cli::exit_good;
  }
  return cli::exit_good;
}

}  // namespace trk_bridge::programs
