// What CLI11 knows of subcommands and options, as manual pages and completions name it.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// Subcommands and options that help shows, in its order.
std::vector<const CLI::App*> visible_commands(const CLI::App&);
std::vector<const CLI::Option*> visible_options(const CLI::App&);

/// "-h", "--help"
std::vector<std::string> dashed_names(const CLI::Option&);
/// Of what follows the option: "N", or the words that it may be, "none|bz2|lz4"; empty for a flag.
std::string value_name(const CLI::Option&);
/// The words that it may be, where it has a list of them.
std::vector<std::string> value_words(const CLI::Option&);
bool takes_many(const CLI::Option&);

}  // namespace trk_bridge::cli
