// read_mem: prints camera parameters from shared memory (document, section 6.2).
#include <trk/trk_mem.h>

#include "read_struct.h"
#include "test_program.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

int main(int argc, char** argv) {
  CLI::App app("Prints camera parameters from shared memory, looking once a second for thirty seconds.", "read_mem");
  int slot = 0;
  app.add_option("SLOT", slot, "Shared memory slot, 0 to 61")->required();
  return run_test_program(app, argc, argv, [&] {
    trkHandle handle = nullptr;
    require(trkMemOpen(slot, &handle), "slot " + std::to_string(slot));
    const cli::ExitCode code = poll_and_print({[=](trkCameraConstants* c) { return trkMemReadConstants(handle, c); },
                                          [=](trkCameraParams* p) { return trkMemReadParams(handle, p); }});
    require(trkMemClose(handle), "closing");
    return code;
  });
}
