// write_net: sends moving camera parameters onto the network (document, section 6.2).
#include <trk/trk_net.h>

#include "test_program.h"
#include "write_struct.h"

using namespace trk_bridge;
using namespace trk_bridge::programs;

int main(int argc, char** argv) {
  CLI::App app("Sends camera parameters that move one after another to a host, 50 sets a second.", "write_net");
  app.footer(format_words_help);
  std::string host, encoding;
  int port = 0;
  std::vector<std::string> words;
  app.add_option("HOST", host, "Receiver's name or address")->required();
  app.add_option("PORT", port, "Receiver's UDP port, 1 to 65535")->required();
  app.add_option("ENCODING", encoding, "How to send: ascii or binary")
      ->required()
      ->check(CLI::IsMember({"ascii", "binary"}));
  app.add_option("FORMAT", words, "Format words");
  return run_test_program(app, argc, argv, [&] {
    const unsigned format = format_from_arguments(words);
    trkHandle handle = nullptr;
    require(trkNetOpenWrite(host.c_str(), port, encoding == "binary", &handle), host + ":" + std::to_string(port));
    const cli::ExitCode code = write_motion({[=](const trkCameraConstants* c) { return trkNetWriteConstants(handle, c); },
                                        [=](const trkCameraParams* p) { return trkNetWriteParams(handle, p); }},
                                       format);
    require(trkNetClose(handle), "closing");
    return code;
  });
}
