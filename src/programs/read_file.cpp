// read_file: prints camera parameters from a file (document, section 6.2).
#include <trk/trk_file.h>

#include <array>

#include "read_struct.h"
#include "test_program.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

namespace {

cli::ExitCode print_file(const std::string& name) {
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints the camera parameters of a file.", "read_file");
  std::string name;
  app.add_option("FILE", name, "File to read")->required();
  return run_test_program(app, argc, argv, [&] { return print_file(name); });
}
