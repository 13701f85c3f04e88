// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Arguments shared by several programs, and the handling of errors at the end of a program.
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

/// All functions below throw CLI::ValidationError with the text of the parser.
transport::SourceEndpoint source_from(const std::string& url);
/// `default_preset`: see endpoints::parse_sink.
transport::SinkEndpoint sink_from(const std::string& url, const std::string& default_preset = {});
/// A format that can be written. The error begins with `option`.
std::uint32_t format_from(const std::string& words, const std::string& option = "--format: ");
/// The preset with that name.
endpoints::Preset preset_from(const std::string& name);

/// A check for Option::check of CLI11, with a plain error text.
using Check = std::function<std::string(const std::string&)>;
/// A whole number from `least` to `most`; by default there is no upper limit.
Check whole_number(std::uint64_t least, std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// A number from `least` to `most`.
Check number(double least, double most);
/// A number above 0.
Check positive_number();
/// A file name that ends in .svg.
std::string is_svg(const std::string& path);
/// Throws a std::runtime_error that names the path.
void write_whole_file(const std::string& path, const std::string& text);

/// Opens /dev/null for closed standard descriptors, parses and runs. An exception becomes one line on standard error
/// and an exit code: exit_usage for CLI errors, exit_failed for all others. For an unknown subcommand or option, the
/// error names the nearest known one.
ExitCode run_program(CLI::App&, int argc, const char* const* argv, const std::function<ExitCode()>& run);

}  // namespace trk_bridge::cli
