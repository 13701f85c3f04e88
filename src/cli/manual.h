// Help texts beyond those of CLI11, and the manual page.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace trk_bridge::cli {

/// A term and what it means.
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

/// For a terminal, in lines of at most 100 columns where words allow it.
std::string plain_text(const std::vector<HelpSection>&);

/// The manual page of section 1, for man: of the program, its subcommands and all their options, as `app` declares
/// them, and then of `more`.
std::string manual_page(const CLI::App& app, const std::string& version, const std::vector<HelpSection>& more);

}  // namespace trk_bridge::cli
