// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "manual.h"

#include <algorithm>
#include <sstream>

#include "option_text.h"

namespace trk_bridge::cli {
namespace {

constexpr std::size_t line_width = 100, term_width = 22;

/// Breaks text into lines. The first line begins at column `at`, each later line with `indent` spaces.
std::string wrapped(const std::string& text, std::size_t at, std::size_t indent) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t column = at;
  while (words >> word) {
    if (column > indent && column + 1 + word.size() > line_width) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!lines.empty()) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

/// Escapes text for troff: backslashes and hyphens stay unchanged, and no line begins a request.
std::string troff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + troff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + troff(text) + "\\fR"; }

void add_entry(std::string& page, const std::string& term, const std::string& meaning) {
  page += ".TP\n" + term + "\n" + troff(meaning) + "\n";
}

std::string synopsis(const CLI::App& command, const std::string& name) {
  std::string line = bold(name);
  const auto options = visible_options(command);
  if (std::any_of(options.begin(), options.end(), [](const auto* option) { return !option->get_positional(); })) {
    line += " [" + italic("OPTION") + "]...";
  }
  for (const auto* option : options) {
    if (!option->get_positional()) continue;
    const std::string word = italic(option->get_name()) + (takes_many(*option) ? "..." : "");
    line += option->get_required() ? ' ' + word : " [" + word + ']';
  }
  return line;
}

void add_options(std::string& page, const CLI::App& command) {
  for (const auto* option : visible_options(command)) {
    std::string term = option->get_positional() ? italic(option->get_name()) : "";
    for (const auto& name : dashed_names(*option)) term += (term.empty() ? "" : ", ") + bold(name);
    const std::string value = option->get_positional() ? "" : value_name(*option);
    if (!value.empty()) term += ' ' + italic(value);
    add_entry(page, term, option->get_description());
  }
}

}  // namespace

std::string plain_text(const std::vector<HelpSection>& sections) {
  std::string text;
  for (const auto& section : sections) {
    text += (text.empty() ? "" : "\n") + section.title + ":\n";
    if (!section.text.empty()) text += "  " + wrapped(section.text, 2, 2) + '\n';
    for (const auto& entry : section.entries) {
      const std::string term = "  " + entry.term;
      const bool fits = term.size() < term_width;
      text += term + (fits ? std::string(term_width - term.size(), ' ') : '\n' + std::string(term_width, ' '));
      text += wrapped(entry.meaning, term_width, term_width) + '\n';
    }
  }
  return text;
}

std::string manual_page(const CLI::App& app, const std::string& version, const std::vector<HelpSection>& more) {
  const std::string& name = app.get_name();
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  // Without hyphenation and with a ragged right margin, so that words can be copied.
  std::string page = ".TH " + title + " 1 \"\" \"trk_bridge " + version + "\" \"User Commands\"\n.nh\n.ad l\n";
  std::string what = app.get_description();
  if (!what.empty() && what.back() == '.') what.pop_back();
  page += ".SH NAME\n" + troff(name) + " \\- " + troff(what) + "\n.SH SYNOPSIS\n";
  const auto commands = visible_commands(app);
  for (const auto* command : commands) {
    page += synopsis(*command, name + ' ' + command->get_name()) + "\n.br\n";
  }
  page += bold(name) + " [" + italic("OPTION") + "]\n.SH OPTIONS\n";
  add_options(page, app);
  if (!app.get_footer().empty()) page += ".PP\n" + troff(app.get_footer()) + '\n';
  page += ".SH COMMANDS\n";
  for (const auto* command : commands) {
    page += ".SS " + synopsis(*command, name + ' ' + command->get_name()) + '\n';
    page += troff(command->get_description()) + ".\n";
    add_options(page, *command);
    if (!command->get_footer().empty()) page += ".PP\n" + troff(command->get_footer()) + '\n';
  }
  for (const auto& section : more) {
    std::string heading = section.title;
    std::transform(heading.begin(), heading.end(), heading.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
    page += ".SH " + troff(heading) + '\n' + troff(section.text) + '\n';
    for (const auto& entry : section.entries) add_entry(page, bold(entry.term), entry.meaning);
  }
  page += ".SH EXIT STATUS\n";
  add_entry(page, bold("0"), "Success.");
  add_entry(page, bold("1"), "Something could not be opened, received or sent.");
  add_entry(page, bold("2"), "The command line was not understood.");
  add_entry(page, bold("3"), "dump or relay received nothing, although --count or --seconds was given.");
  add_entry(page, bold("4"), "An alarm was raised (--alarm).");
  return page;
}

}  // namespace trk_bridge::cli
