// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "completion.h"

#include <algorithm>

#include "option_text.h"

namespace trk_bridge::cli {
namespace {

/// The name of a function of the script that its specifications use.
constexpr const char* words_of_zsh = "_trk_bridge_words";

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// The possible values of an option or argument.
struct Values {
  std::vector<std::string> words;
  bool is_file = false;
};

Values values_of(const CLI::Option& option, const Completions& known) {
  auto words = value_words(option);
  if (const auto found = known.find(option.get_name()); found != known.end()) words = found->second;
  const bool names_file = option.get_positional() || option.get_type_name().find("FILE") != std::string::npos;
  return {words, words.empty() && names_file};
}

std::string bash_values(const Values& values) {
  if (!values.words.empty()) return "words=\"" + joined(values.words) + '"';
  return values.is_file ? "files=1" : ":";
}

/// The branch of the script for one command's options and arguments.
std::string bash_branch(const CLI::App& command, const Completions& known) {
  std::vector<std::string> names;
  std::string with_values, arguments = ":";
  for (const auto* option : visible_options(command)) {
    if (option->get_positional()) {
      // All arguments of a command are of one kind, or files.
      arguments = bash_values(values_of(*option, known));
      continue;
    }
    const auto dashed = dashed_names(*option);
    names.insert(names.end(), dashed.begin(), dashed.end());
    if (option->get_items_expected_max() == 0) continue;
    with_values += "        " + joined(dashed, "|") + ") " + bash_values(values_of(*option, known)) + " ;;\n";
  }
  std::string branch = "      case $previous in\n" + with_values;
  branch += "        *) if [[ $current == -* ]]; then words=\"" + joined(names) + "\"; else " + arguments + "; fi ;;\n";
  return branch + "      esac\n";
}

/// Escaped for a specification of zsh in single quotes.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'') {
      escaped += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

std::string zsh_values(const std::string& name, const Values& values) {
  const std::string message = ':' + zsh_text(name) + ':';
  if (!values.words.empty()) return message + ' ' + words_of_zsh + ' ' + zsh_text(joined(values.words));
  return message + (values.is_file ? "_files" : " ");
}

/// The specifications of one command's options and arguments, for _arguments.
std::string zsh_specifications(const CLI::App& command, const Completions& known) {
  std::string all;
  for (const auto* option : visible_options(command)) {
    const auto values = values_of(*option, known);
    if (option->get_positional()) {
      all += std::string(" '") + (takes_many(*option) ? "*" : "") + zsh_values(option->get_name(), values) + '\'';
      continue;
    }
    for (const auto& name : dashed_names(*option)) {
      all += " '" + name + '[' + zsh_text(option->get_description()) + ']';
      if (option->get_items_expected_max() > 0) all += zsh_values(value_name(*option), values);
      all += '\'';
    }
  }
  return all;
}

}  // namespace

std::string bash_completion(const CLI::App& app, const Completions& known) {
  const std::string& name = app.get_name();
  const std::string function = '_' + name;
  std::vector<std::string> commands;
  for (const auto* command : visible_commands(app)) commands.push_back(command->get_name());
  std::string script = "# Completion of " + name + " for bash: written by " + name + " completion bash.\n" + function +
                       R"(() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= words= files=
  local -i i
  COMPREPLY=()
  # bash splits a URL into several words at its colons.
  if [[ $previous == file && $current == : ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f)
    return 0
  fi
  if [[ $previous == : ]]; then
    [[ ${COMP_WORDS[COMP_CWORD - 2]} == file ]] || return 0
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    return 0
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  case $command in
    '')
)";
  std::vector<std::string> names;
  for (const auto* option : visible_options(app)) {
    for (const auto& dashed : dashed_names(*option)) names.push_back(dashed);
  }
  script += "      words=\"" + joined(commands) + ' ' + joined(names) + "\" ;;\n";
  for (const auto* command : visible_commands(app)) {
    script += "    " + command->get_name() + ")\n" + bash_branch(*command, known) + "      ;;\n";
  }
  script += R"(  esac
  if [[ -n $files ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    [[ ${COMPREPLY[0]-} == *[:/] ]] && compopt -o nospace 2>/dev/null
  fi
  return 0
}
)";
  return script + "complete -F " + function + ' ' + name + '\n';
}

std::string zsh_completion(const CLI::App& app, const Completions& known) {
  const std::string& name = app.get_name();
  const std::string function = '_' + name;
  std::string script = "#compdef " + name + "\n# Completion of " + name + " for zsh: written by " + name +
                       " completion zsh.\n\n" + words_of_zsh + R"(() {
  if compset -P 'file:'; then
    _files
  else
    compadd -S '' -- ${(M)@:#*[:/]}
    compadd -- ${@:#*[:/]}
  fi
}

)" + function + R"(() {
  local curcontext=$curcontext state line
  local -a commands
  typeset -A opt_args
  commands=(
)";
  for (const auto* command : visible_commands(app)) {
    script += "    '" + command->get_name() + ':' + zsh_text(command->get_description()) + "'\n";
  }
  script += "  )\n  _arguments -C" + zsh_specifications(app, known) +
            " '1:command:->command' '*::argument:->arguments' && return\n"
            "  case $state in\n"
            "    command) _describe -t commands command commands ;;\n"
            "    arguments)\n"
            "      case $line[1] in\n";
  for (const auto* command : visible_commands(app)) {
    script += "        " + command->get_name() + ") _arguments" + zsh_specifications(*command, known) + " ;;\n";
  }
  // When autoloaded, the file is the body of the function; when sourced, it defines the function.
  script += "      esac ;;\n  esac\n}\n\nif [[ $funcstack[1] == " + function + " ]]; then\n  " + function +
            " \"$@\"\nelse\n  compdef " + function + ' ' + name + "\nfi\n";
  return script;
}

}  // namespace trk_bridge::cli
