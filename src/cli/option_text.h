// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Subcommands and options of CLI11, as manual pages and completions show them.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// Subcommands and options that the help shows, in the same order.
std::vector<const CLI::App*> visible_commands(const CLI::App&);
std::vector<const CLI::Option*> visible_options(const CLI::App&);

/// "-h", "--help"
std::vector<std::string> dashed_names(const CLI::Option&);
/// The name of the option's value: "N", or its possible words, "none|bz2|lz4"; empty for a flag.
std::string value_name(const CLI::Option&);
/// The possible words of the value, if it has a list of them.
std::vector<std::string> value_words(const CLI::Option&);
bool takes_many(const CLI::Option&);

}  // namespace trk_bridge::cli
