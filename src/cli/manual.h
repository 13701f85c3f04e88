// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Help texts that CLI11 does not have, and the manual page.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// A term and its meaning.
struct HelpEntry {
  std::string term;
  std::string meaning;
};

/// A part of a help text: a title, a paragraph that may be empty, and entries.
struct HelpSection {
  std::string title;
  std::string text;
  std::vector<HelpEntry> entries;
};

/// For a terminal, in lines of at most 100 columns unless a word is longer.
std::string plain_text(const std::vector<HelpSection>&);

/// The manual page (section 1) of the program, its subcommands and all their options, as `app` declares them, followed
/// by `more`.
std::string manual_page(const CLI::App& app, const std::string& version, const std::vector<HelpSection>& more);

}  // namespace trk_bridge::cli
