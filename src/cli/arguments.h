// Arguments that several programs share, and how their errors end a program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "endpoints/presets.h"
#include "exit_code.h"
#include "trk_bridge/endpoints/endpoints.h"

namespace trk_bridge::cli {

/// For the end of a help text.
inline constexpr const char* endpoints_help =
    "An endpoint is udp://[HOST]:PORT, shm:SLOT, file:PATH or freed://[HOST]:PORT, with options behind a question "
    "mark.";

/// All throw CLI::ValidationError with the parser's text.
transport::SourceEndpoint source_from(const std::string& url);
/// `default_preset`: see endpoints::parse_sink.
transport::SinkEndpoint sink_from(const std::string& url, const std::string& default_preset = {});
/// A format that records may be made in. The error begins with `option`.
std::uint32_t format_from(const std::string& words, const std::string& option = "--format: ");
/// The preset of that name.
endpoints::Preset preset_from(const std::string& name);

/// A check of CLI11: the name of a drawing.
std::string is_svg(const std::string& path);
/// Throws std::runtime_error that names the path.
void write_whole_file(const std::string& path, const std::string& text);

/// Opens standard descriptors that are closed on /dev/null, parses, runs, and turns what is thrown into one line on
/// standard error and an exit code: exit_usage for CLI's errors, exit_failed for all others.
ExitCode run_program(CLI::App&, int argc, const char* const* argv, const std::function<ExitCode()>& run);

}  // namespace trk_bridge::cli
