// Arguments that several programs share, and how their errors end a program.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include <CLI/CLI.hpp>

#include "endpoints/presets.h"
#include "exit_code.h"
#include "trk_bridge/endpoints/endpoints.h"

namespace trk_bridge::cli {

/// For the end of a help text.
std::string endpoints_help();

/// All throw CLI::ValidationError with the parser's text.
transport::SourceEndpoint source_from(const std::string& url);
/// `default_preset`: see endpoints::parse_sink.
transport::SinkEndpoint sink_from(const std::string& url, const std::string& default_preset = {});
/// A format that records may be made in. The error begins with `option`.
std::uint32_t format_from(const std::string& words, const std::string& option = "--format: ");
/// The preset of that name.
endpoints::Preset preset_from(const std::string& name);

/// A check of CLI11 by a plain error; all are for Option::check.
using Check = std::function<std::string(const std::string&)>;
/// A whole number from `least` to `most`; by default there is no upper limit.
Check whole_number(std::uint64_t least, std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// A number from `least` to `most`.
Check number(double least, double most);
/// A number above 0.
Check positive_number();
/// The name of a drawing.
std::string is_svg(const std::string& path);
/// Throws std::runtime_error that names the path.
void write_whole_file(const std::string& path, const std::string& text);

/// Opens standard descriptors that are closed on /dev/null, parses, runs, and turns what is thrown into one line on
/// standard error and an exit code: exit_usage for CLI's errors, exit_failed for all others. Of an unknown subcommand
/// or option, the error names the nearest.
ExitCode run_program(CLI::App&, int argc, const char* const* argv, const std::function<ExitCode()>& run);

}  // namespace trk_bridge::cli
