// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Scripts for command line completion in shells.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// Possible values by the name of their argument ("SOURCE", "--preset"). No space is added after a word that ends in
/// `:` or `/`, and what follows `file:` is completed as a path.
using Completions = std::map<std::string, std::vector<std::string>>;

/// Completes the subcommands, options and values that `app` declares. Files are offered for arguments without known
/// values, nothing for options without known values.
std::string bash_completion(const CLI::App& app, const Completions&);
std::string zsh_completion(const CLI::App& app, const Completions&);

}  // namespace trk_bridge::cli
