// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "programs.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/process.h"
#include "cli/stop_signals.h"
#include "motion.h"
#include "print.h"
#include "trk_bridge/wire/format.h"
#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"

namespace trk_bridge::programs {
namespace {

constexpr int seconds_of_reading = 30;
constexpr std::chrono::milliseconds field_time{20};
constexpr const char* time_code = "00:00:00:00:1";

using Arguments = std::vector<std::string>;

/// Throws std::runtime_error "WHAT: error" unless the call succeeded.
void require(trkError error, const std::string& what) {
  if (error != trkOK) throw std::runtime_error(what + ": " + trkErrorMessage(error));
}

/// A whole number; the C interface checks whether it is a valid slot or port.
int number_from(const std::string& text, const std::string& what) {
  int number = 0;
  const char* const end = text.data() + text.size();
  if (const auto read = std::from_chars(text.data(), end, number); read.ec != std::errc{} || read.ptr != end) {
    throw std::runtime_error(what + " '" + text + "': must be a whole number");
  }
  return number;
}

/// The format mask of the words from index `first`.
unsigned format_from(const Arguments& arguments, std::size_t first) {
  std::string words;
  for (std::size_t i = first; i < arguments.size(); ++i) words += arguments[i] + ' ';
  const auto format = wire::format_from_words(words);
  if (!format) throw std::runtime_error(format.error());
  if (const auto writable = wire::check_writable(*format); !writable) throw std::runtime_error(writable.error());
  return *format;
}

/// Steps of equal length without drift. A signal that StopSignals caught ends the wait.
class Pace {
 public:
  explicit Pace(std::chrono::nanoseconds step)
      : step_(step), next_(std::chrono::steady_clock::now().time_since_epoch()) {}

  /// Waits until the next step is due. False after a signal.
  bool wait() {
    next_ += step_;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(next_);
    const timespec until{static_cast<time_t>(seconds.count()), static_cast<long>((next_ - seconds).count())};
    while (!cli::StopSignals::stopped()) {
      const int error = ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      if (error == 0) return !cli::StopSignals::stopped();
      if (error != EINTR) throw std::system_error(error, std::generic_category(), "waiting");
    }
    return false;
  }

 private:
  const std::chrono::nanoseconds step_;
  std::chrono::nanoseconds next_;
};

template <typename Record>
using Read = trkError (*)(trkHandle, Record*);
template <typename Record>
using Write = trkError (*)(trkHandle, const Record*);

/// Throws std::system_error if the output cannot be written.
void flush() {
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "writing");
}

/// Prints a new record. False if there is none; an invalid one is reported.
template <typename Record>
bool print_new(trkHandle handle, Read<Record> read) {
  Record record{};
  const trkError error = read(handle, &record);
  if (error == trkOK) print(stdout, record);
  if (error == trkInvalidVersion) std::fprintf(stderr, "%s\n", trkErrorMessage(error));
  if (error == trkFailed || error == trkInvalidHandle) require(error, "reading");
  return error == trkOK;
}

/// Prints new records once a second for thirty seconds, or until a signal.
void print_for_a_while(trkHandle handle, Read<trkCameraConstants> read_constants, Read<trkCameraParams> read_params) {
  const cli::StopSignals signals;
  Pace pace{std::chrono::seconds(1)};
  for (int second = 0; second <= seconds_of_reading; ++second) {
    print_new(handle, read_constants);
    if (!print_new(handle, read_params)) std::fputs("No new camera parameters.\n\n", stdout);
    flush();
    if (second < seconds_of_reading && !pace.wait()) return;
  }
}

/// Constants and the whole motion at 50 sets a second, or until a signal.
void write_motion(trkHandle handle, Write<trkCameraConstants> write_constants, Write<trkCameraParams> write_params,
                  const Motion& motion) {
  const cli::StopSignals signals;
  const trkCameraConstants constants = motion.constants();
  require(write_constants(handle, &constants), "writing");
  Pace pace{field_time};
  for (unsigned i = 0; i < Motion::sets; ++i) {
    const trkCameraParams params = motion.params(i);
    require(write_params(handle, &params), "writing");
    if (!pace.wait()) return;
  }
}

void read_mem(const Arguments& arguments) {
  trkHandle handle = nullptr;
  require(trkMemOpen(number_from(arguments[0], "slot"), &handle), "slot " + arguments[0]);
  print_for_a_while(handle, trkMemReadConstants, trkMemReadParams);
  require(trkMemClose(handle), "closing");
}

void write_mem(const Arguments& arguments) {
  const Motion motion(format_from(arguments, 1));
  trkHandle handle = nullptr;
  require(trkMemOpen(number_from(arguments[0], "slot"), &handle), "slot " + arguments[0]);
  write_motion(handle, trkMemWriteConstants, trkMemWriteParams, motion);
  require(trkMemClose(handle), "closing");
}

void read_net(const Arguments& arguments) {
  trkHandle handle = nullptr;
  require(trkNetOpenRead(number_from(arguments[0], "port"), &handle), "port " + arguments[0]);
  print_for_a_while(handle, trkNetReadConstants, trkNetReadParams);
  require(trkNetClose(handle), "closing");
}

void write_net(const Arguments& arguments) {
  const bool binary = arguments.size() > 2 && arguments[2] == "binary";
  const Motion motion(format_from(arguments, binary ? 3 : 2));
  trkHandle handle = nullptr;
  require(trkNetOpenWrite(arguments[0].c_str(), number_from(arguments[1], "port"), binary ? 1 : 0, &handle),
          arguments[0] + ":" + arguments[1]);
  write_motion(handle, trkNetWriteConstants, trkNetWriteParams, motion);
  require(trkNetClose(handle), "closing");
}

void read_file(const Arguments& arguments) {
  const std::string& name = arguments[0];
  std::array<char, trkTimeCodeSize> code{};
  trkCameraConstants constants{};
  trkHandle handle = nullptr;
  require(trkFileOpenRead(name.c_str(), code.data(), &constants, &handle), name);
  // The output that scripts parse begins with the constants.
  std::fprintf(stderr, "Time code: %s\n", code.data());
  print(stdout, constants);
  trkCameraParams params{};
  trkError error = trkOK;
  while (error != trkUnavailable) {
    error = trkFileReadParams(handle, &params);
    if (error == trkOK) print(stdout, params);
    if (error == trkInvalidVersion) std::fprintf(stderr, "%s: %s\n", name.c_str(), trkErrorMessage(error));
    if (error == trkFailed || error == trkInvalidHandle) require(error, name);
  }
  flush();
  require(trkFileClose(handle), "closing " + name);
}

void write_file(const Arguments& arguments) {
  const std::string& name = arguments[0];
  const Motion motion(format_from(arguments, 1));
  const trkCameraConstants constants = motion.constants();
  trkHandle handle = nullptr;
  require(trkFileOpenWrite(name.c_str(), time_code, &constants, &handle), name);
  for (unsigned i = 0; i < Motion::sets; ++i) {
    const trkCameraParams params = motion.params(i);
    require(trkFileWriteParams(handle, &params), "writing " + name);
  }
  require(trkFileClose(handle), "closing " + name);
}

struct Program {
  std::string_view name;
  const char* arguments;
  const char* description;
  std::size_t least, most;  // how many arguments
  void (*run)(const Arguments&);
};

constexpr std::size_t any_number = 1000;

constexpr Program programs[] = {
    {"read_mem", "SLOT", "Prints camera parameters from shared memory slot 0 to 61, once a second for 30 seconds.", 1,
     1, read_mem},
    {"write_mem", "SLOT [WORDS]", "Writes moving camera parameters to shared memory slot 0 to 61, 50 sets a second.", 1,
     any_number, write_mem},
    {"read_net", "PORT", "Prints camera parameters from the network, once a second for 30 seconds.", 1, 1, read_net},
    {"write_net", "HOST PORT [binary] [WORDS]", "Sends moving camera parameters to a host, 50 sets a second.", 2,
     any_number, write_net},
    {"read_file", "FILE", "Prints the camera parameters of a file.", 1, 1, read_file},
    {"write_file", "FILE [WORDS]", "Writes moving camera parameters to a file; an existing file is replaced.", 1,
     any_number, write_file},
};

const Program& program_named(std::string_view name) {
  for (const Program& program : programs) {
    if (program.name == name) return program;
  }
  throw std::logic_error("the table has no program of that name");
}

void print_usage(std::FILE* out, const Program& program) {
  std::fprintf(out, "Usage: %s %s\n%s\n", std::string(program.name).c_str(), program.arguments, program.description);
  if (program.most == 1) return;
  std::fputs(
      "WORDS select the format of the parameters; the first of each group is the default:\n"
      "  matrix euler\n"
      "  camera_to_studio studio_to_camera\n"
      "  camera_z_up camera_y_up\n"
      "  studio_z_up studio_y_up\n"
      "  image_distance field_of_view\n"
      "  horizontal vertical diagonal\n"
      "  consider_blank ignore_blank\n"
      "  adjust_aspect keep_aspect\n"
      "  shift_on_chip shift_in_pixels\n",
      out);
}

}  // namespace

int run(const char* name, int argc, char** argv) {
  base::open_standard_descriptors();
  try {
    const Program& program = program_named(name);
    const Arguments arguments(argv + 1, argv + argc);
    if (arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h")) {
      print_usage(stdout, program);
      return 0;
    }
    if (arguments.size() < program.least || arguments.size() > program.most) {
      print_usage(stderr, program);
      return 1;
    }
    program.run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
  return 0;
}

}  // namespace trk_bridge::programs
