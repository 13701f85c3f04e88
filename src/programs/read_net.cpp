// read_net: prints camera parameters from the network (document, section 6.2).
#include <trk/trk_net.h>

#include "read_struct.h"
#include "test_program.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

int main(int argc, char** argv) {
  CLI::App app("Prints camera parameters from the network, looking once a second for thirty seconds.", "read_net");
  int port = 0;
  app.add_option("PORT", port, "UDP port to receive on, 1 to 65535")->required();
  return run_test_program(app, argc, argv, [&] {
    trkHandle handle = nullptr;
    require(trkNetOpenRead(port, &handle), "port " + std::to_string(port));
    const cli::ExitCode code = poll_and_print({[=](trkCameraConstants* c) { return trkNetReadConstants(handle, c); },
                                          [=](trkCameraParams* p) { return trkNetReadParams(handle, p); }});
    require(trkNetClose(handle), "closing");
    return code;
  });
}
