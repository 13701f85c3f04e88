// Scripts by which shells complete a command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// What a value may be, by its argument's name ("SOURCE", "--preset"). After a word that ends in `:` or `/` no space
/// follows, and the rest of one that begins with `file:` is completed as a path.
using Completions = std::map<std::string, std::vector<std::string>>;

/// Subcommands, options and values of `app`, as it declares them. Where nothing is known of an argument, files are
/// offered; where nothing is known of an option's value, nothing.
std::string bash_completion(const CLI::App& app, const Completions&);
std::string zsh_completion(const CLI::App& app, const Completions&);

}  // namespace trk_bridge::cli
