// write_file: writes moving camera parameters to a file (document, section 6.2).
#include <trk/trk_file.h>

#include "test_program.h"
#include "write_struct.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

namespace {

cli::ExitCode write_file(const std::string& name, const std::string& time_code, unsigned format) {
  const trkCameraConstants constants = test_constants(format);
  trkHandle handle = nullptr;
  require(trkFileOpenWrite(name.c_str(), time_code.c_str(), &constants, &handle), name);
  for (unsigned i = 0; i < test_sets; ++i) {
    const trkCameraParams params = test_params(i, format);
    require(trkFileWriteParams(handle, &params), "writing " + name);
  }
  require(trkFileClose(handle), "closing " + name);
  return cli::exit_good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes camera parameters that move one after another to a file, in the place of one of that name.",
               "write_file");
  app.footer(format_words_help);
  std::string name;
  std::string time_code = "00:00:00:00:1";
  std::vector<std::string> words;
  app.add_option("FILE", name, "File to write")->required();
  app.add_option("FORMAT", words, "Format words");
  app.add_option("--timecode", time_code, "Time code of the first field, HH:MM:SS:FF:D")->capture_default_str();
  return run_test_program(app, argc, argv, [&] { return write_file(name, time_code, format_from_arguments(words)); });
}
