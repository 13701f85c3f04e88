// The document's test programs (section 6.2), which use the C interface: one source, built once for each name in the
// table below, which is TRK_BRIDGE_PROGRAM.
#include <trk/trk_file.h>
#include <trk/trk_mem.h>
#include <trk/trk_net.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/arguments.h"
#include "cli/stop_signals.h"
#include "motion.h"
#include "print.h"

namespace trk_bridge::programs {
namespace {

constexpr int seconds_of_reading = 30;
constexpr std::chrono::milliseconds field_time{20};

constexpr const char* format_words_help =
    "Format words: matrix euler, camera_to_studio studio_to_camera, camera_z_up camera_y_up, studio_z_up studio_y_up,\n"
    "image_distance field_of_view, horizontal vertical diagonal, consider_blank ignore_blank, adjust_aspect "
    "keep_aspect,\n"
    "shift_on_chip shift_in_pixels. The first of each group is the default.";

/// The command line of any of them.
struct Arguments {
  int slot = 0, port = 0;
  std::string host, encoding, file;
  std::string time_code = "00:00:00:00:1";
  std::vector<std::string> words;

  std::string slot_text() const { return "slot " + std::to_string(slot); }
  unsigned format() const {
    std::string all;
    for (const std::string& word : words) all += word + ' ';
    return cli::format_from(all, "");
  }
};

void add_slot(CLI::App& app, Arguments& arguments) {
  app.add_option("SLOT", arguments.slot, "Shared memory slot, 0 to 61")->required();
}

void add_format(CLI::App& app, Arguments& arguments) {
  app.footer(format_words_help);
  app.add_option("FORMAT", arguments.words, "Format words");
}

/// Throws std::runtime_error "WHAT: error" unless the call went well.
void require(trkError error, const std::string& what) {
  if (error != trkOK) throw std::runtime_error(what + ": " + trkErrorMessage(error));
}

/// Steps of equal length that do not drift. A signal that StopSignals has caught ends the waiting early.
class Pace {
 public:
  explicit Pace(std::chrono::nanoseconds step)
      : step_(step), next_(std::chrono::steady_clock::now().time_since_epoch()) {}

  /// Until the next step is due. False when a signal came.
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

/// False when the transfer has to end. An invalid record does not end it.
template <typename Record>
bool print_new(trkHandle handle, Read<Record> read) {
  Record record{};
  const trkError error = read(handle, &record);
  if (error == trkOK) print(std::cout, record);
  if (error == trkOK || error == trkUnavailable) return true;
  std::cerr << trkErrorMessage(error) << '\n';
  return error == trkInvalidVersion;
}

/// Looks once a second for thirty seconds, or until a signal, and prints what is new.
cli::ExitCode print_for_a_while(trkHandle handle, Read<trkCameraConstants> read_constants,
                                Read<trkCameraParams> read_params) {
  const cli::StopSignals signals;
  Pace pace{std::chrono::seconds(1)};
  for (int second = 0; second <= seconds_of_reading; ++second) {
    const bool is_good = print_new(handle, read_constants) && print_new(handle, read_params);
    if (!is_good || !std::cout) return cli::exit_failed;
    if (second < seconds_of_reading && !pace.wait()) return cli::exit_good;
  }
  return cli::exit_good;
}

template <typename Record>
bool is_written(trkHandle handle, Write<Record> write, const Record& record) {
  const trkError error = write(handle, &record);
  if (error != trkOK) std::cerr << "writing: " << trkErrorMessage(error) << '\n';
  return error == trkOK;
}

/// Constants and the whole motion at 50 sets a second, or until a signal.
cli::ExitCode write_motion(trkHandle handle, Write<trkCameraConstants> write_constants,
                           Write<trkCameraParams> write_params, const Motion& motion) {
  const cli::StopSignals signals;
  if (!is_written(handle, write_constants, motion.constants())) return cli::exit_failed;
  Pace pace{field_time};
  for (unsigned i = 0; i < Motion::sets; ++i) {
    if (!is_written(handle, write_params, motion.params(i))) return cli::exit_failed;
    if (!pace.wait()) return cli::exit_good;
  }
  return cli::exit_good;
}

cli::ExitCode read_mem(const Arguments& arguments) {
  trkHandle handle = nullptr;
  require(trkMemOpen(arguments.slot, &handle), arguments.slot_text());
  const cli::ExitCode code = print_for_a_while(handle, trkMemReadConstants, trkMemReadParams);
  require(trkMemClose(handle), "closing");
  return code;
}

cli::ExitCode write_mem(const Arguments& arguments) {
  const Motion motion(arguments.format());
  trkHandle handle = nullptr;
  require(trkMemOpen(arguments.slot, &handle), arguments.slot_text());
  const cli::ExitCode code = write_motion(handle, trkMemWriteConstants, trkMemWriteParams, motion);
  require(trkMemClose(handle), "closing");
  return code;
}

cli::ExitCode read_net(const Arguments& arguments) {
  trkHandle handle = nullptr;
  require(trkNetOpenRead(arguments.port, &handle), "port " + std::to_string(arguments.port));
  const cli::ExitCode code = print_for_a_while(handle, trkNetReadConstants, trkNetReadParams);
  require(trkNetClose(handle), "closing");
  return code;
}

cli::ExitCode write_net(const Arguments& arguments) {
  const Motion motion(arguments.format());
  trkHandle handle = nullptr;
  require(trkNetOpenWrite(arguments.host.c_str(), arguments.port, arguments.encoding == "binary", &handle),
          arguments.host + ":" + std::to_string(arguments.port));
  const cli::ExitCode code = write_motion(handle, trkNetWriteConstants, trkNetWriteParams, motion);
  require(trkNetClose(handle), "closing");
  return code;
}

cli::ExitCode read_file(const Arguments& arguments) {
  const std::string& name = arguments.file;
  std::array<char, trkTimeCodeSize> time_code{};
  trkCameraConstants constants{};
  trkHandle handle = nullptr;
  require(trkFileOpenRead(name.c_str(), time_code.data(), &constants, &handle), name);
  std::cout << "time code: " << time_code.data() << '\n';
  print(std::cout, constants);
  trkCameraParams params{};
  trkError error = trkFileReadParams(handle, &params);
  for (; error == trkOK && std::cout; error = trkFileReadParams(handle, &params)) print(std::cout, params);
  require(trkFileClose(handle), "closing " + name);
  if (error != trkOK && error != trkUnavailable) require(error, name);
  return std::cout ? cli::exit_good : cli::exit_failed;
}

cli::ExitCode write_file(const Arguments& arguments) {
  const std::string& name = arguments.file;
  const Motion motion(arguments.format());
  const trkCameraConstants constants = motion.constants();
  trkHandle handle = nullptr;
  require(trkFileOpenWrite(name.c_str(), arguments.time_code.c_str(), &constants, &handle), name);
  for (unsigned i = 0; i < Motion::sets; ++i) {
    const trkCameraParams params = motion.params(i);
    require(trkFileWriteParams(handle, &params), "writing " + name);
  }
  require(trkFileClose(handle), "closing " + name);
  return cli::exit_good;
}

struct Program {
  std::string_view name;
  const char* description;
  void (*add_arguments)(CLI::App&, Arguments&);
  cli::ExitCode (*run)(const Arguments&);
};

constexpr Program programs[] = {
    {"read_mem", "Prints camera parameters from shared memory, looking once a second for thirty seconds.", add_slot,
     read_mem},
    {"write_mem", "Writes camera parameters that move one after another to shared memory, 50 sets a second.",
     [](CLI::App& app, Arguments& arguments) {
       add_slot(app, arguments);
       add_format(app, arguments);
     },
     write_mem},
    {"read_net", "Prints camera parameters from the network, looking once a second for thirty seconds.",
     [](CLI::App& app, Arguments& arguments) {
       app.add_option("PORT", arguments.port, "UDP port to receive on, 1 to 65535")->required();
     },
     read_net},
    {"write_net", "Sends camera parameters that move one after another to a host, 50 sets a second.",
     [](CLI::App& app, Arguments& arguments) {
       app.add_option("HOST", arguments.host, "Receiver's name or address")->required();
       app.add_option("PORT", arguments.port, "Receiver's UDP port, 1 to 65535")->required();
       app.add_option("ENCODING", arguments.encoding, "How to send: ascii or binary")
           ->required()
           ->check(CLI::IsMember({"ascii", "binary"}));
       add_format(app, arguments);
     },
     write_net},
    {"read_file", "Prints the camera parameters of a file.",
     [](CLI::App& app, Arguments& arguments) { app.add_option("FILE", arguments.file, "File to read")->required(); },
     read_file},
    {"write_file", "Writes camera parameters that move one after another to a file, in the place of one of that name.",
     [](CLI::App& app, Arguments& arguments) {
       app.add_option("FILE", arguments.file, "File to write")->required();
       add_format(app, arguments);
       app.add_option("--timecode", arguments.time_code, "Time code of the first field, HH:MM:SS:FF:D")
           ->capture_default_str();
     },
     write_file},
};

constexpr const Program& program_named(std::string_view name) {
  for (const Program& program : programs) {
    if (program.name == name) return program;
  }
  throw std::logic_error("the table has no program of that name");
}

}  // namespace
}  // namespace trk_bridge::programs

// Declaring options throws where the program itself is wrong, and ends it: nothing else here is outside run_program.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  using namespace trk_bridge;
  constexpr const programs::Program& program = programs::program_named(TRK_BRIDGE_PROGRAM);
  CLI::App app(program.description, std::string(program.name));
  programs::Arguments arguments;
  program.add_arguments(app, arguments);
  if (argc == 1) {
    std::cerr << app.help();
    return cli::exit_usage;
  }
  return cli::run_program(app, argc, argv, [&] { return program.run(arguments); });
}
