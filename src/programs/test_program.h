// How the six test programs start: without arguments each says which it needs.
#pragma once

#include <iostream>
#include <stdexcept>
#include <string>

#include <trk/trk_struct.h>

#include "cli/arguments.h"

namespace trk_bridge::programs {

/// As run_program, but a command line without arguments brings up the usage message on standard error.
inline cli::ExitCode run_test_program(CLI::App& app, int argc, const char* const* argv,
                                 const std::function<cli::ExitCode()>& run) {
  if (argc > 1) return cli::run_program(app, argc, argv, run);
  std::cerr << app.help();
  return cli::exit_usage;
}

/// Throws a std::runtime_error "WHAT: error" unless the call went well.
inline void require(trkError error, const std::string& what) {
  if (error != trkOK) throw std::runtime_error(what + ": " + trkErrorMessage(error));
}

}  // namespace trk_bridge::programs
