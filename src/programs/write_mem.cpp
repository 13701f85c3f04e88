// write_mem: writes moving camera parameters to shared memory (document, section 6.2).
#include <trk/trk_mem.h>

#include "test_program.h"
#include "write_struct.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

int main(int argc, char** argv) {
  CLI::App app("Writes camera parameters that move one after another to shared memory, 50 sets a second.", "write_mem");
  app.footer(format_words_help);
  int slot = 0;
  std::vector<std::string> words;
  app.add_option("SLOT", slot, "Shared memory slot, 0 to 61")->required();
  app.add_option("FORMAT", words, "Format words");
  return run_test_program(app, argc, argv, [&] {
    const unsigned format = format_from_arguments(words);
    trkHandle handle = nullptr;
    require(trkMemOpen(slot, &handle), "slot " + std::to_string(slot));
    const cli::ExitCode code = write_motion({[=](const trkCameraConstants* c) { return trkMemWriteConstants(handle, c); },
                                        [=](const trkCameraParams* p) { return trkMemWriteParams(handle, p); }},
                                       format);
    require(trkMemClose(handle), "closing");
    return code;
  });
}
