// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "arguments.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/nearest.h"
#include "base/number_text.h"
#include "base/process.h"
#include "base/system_text.h"
#include "endpoints/schemes.h"
#include "option_text.h"
#include "transport/scheme.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::cli {
namespace {

std::string quoted(const std::string& text) { return '"' + text + '"'; }

/// The subcommand in the arguments, else the program itself.
const CLI::App& asked_for(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

bool is_command(const CLI::App& app, const std::string& name) {
  return !app.get_subcommands([&name](const CLI::App* command) { return command->get_name() == name; }).empty();
}

/// Throws if the first argument should be a subcommand but is not: the error of CLI11 would only say that it was not
/// expected.
void check_command(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> names;
  std::string all;
  for (const auto* command : visible_commands(app)) {
    names.push_back(command->get_name());
    all += (all.empty() ? "" : ", ") + names.back();
  }
  if (names.empty()) return;
  if (argc < 2) throw CLI::ValidationError("no command is given; commands are " + all);
  const std::string given = argv[1];
  if (given.empty() || given[0] == '-' || is_command(app, given)) return;
  const auto meant = base::likely(given, names);
  throw CLI::ValidationError("unknown command " + quoted(given) +
                             (meant ? ", did you mean " + *meant + '?' : "; commands are " + all));
}

/// The unexpected argument, and the option that was probably meant.
std::string extras_error(const CLI::App& app) {
  const CLI::App& command = asked_for(app);
  const auto extras = app.remaining(true);
  if (extras.empty()) return "an argument was not expected";
  const std::string& given = extras.front();
  if (given.size() < 2 || given[0] != '-') return "unexpected argument " + quoted(given);
  std::vector<std::string> known;
  for (const auto* option : command.get_options()) {
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  }
  const auto meant = base::likely(given.substr(0, given.find('=')), known);
  return "unknown option " + given + (meant ? ", did you mean " + *meant + "?" : "");
}

/// Prints one line that refers to --help.
ExitCode report_usage(const CLI::App& app, const std::string& what) {
  std::string help = app.get_name();
  if (const CLI::App& command = asked_for(app); &command != &app) help += ' ' + command.get_name();
  std::cerr << app.get_name() << ": error: " << what << " (see " << help << " --help)\n";
  return exit_usage;
}

}  // namespace

std::string endpoints_help() {
  return "An endpoint is one of " + endpoints::usages() +
         ", with options after a question mark: see trk help endpoints.";
}

Check whole_number(std::uint64_t least, std::uint64_t most) {
  return [=](const std::string& text) {
    if (transport::whole_number(text, least, most)) return std::string();
    const bool is_limited = most != std::numeric_limits<std::uint64_t>::max();
    return quoted(text) + ": must be a whole number " +
           (is_limited ? "from " + base::number_text(least) + " to " + base::number_text(most)
                       : "of at least " + base::number_text(least));
  };
}

Check number(double least, double most) {
  return [=](const std::string& text) {
    if (transport::real_number(text, least, most)) return std::string();
    return quoted(text) + ": must be a number from " + base::number_text(least) + " to " + base::number_text(most);
  };
}

Check positive_number() {
  return [](const std::string& text) {
    if (transport::real_number(text, std::numeric_limits<double>::min(), std::numeric_limits<double>::max())) {
      return std::string();
    }
    return quoted(text) + ": must be a number above 0";
  };
}

transport::SourceEndpoint source_from(const std::string& url) {
  auto endpoint = endpoints::parse_source(url);
  if (!endpoint) throw CLI::ValidationError(endpoint.error());
  return *std::move(endpoint);
}

transport::SinkEndpoint sink_from(const std::string& url, const std::string& default_preset) {
  auto endpoint = endpoints::parse_sink(url, default_preset);
  if (!endpoint) throw CLI::ValidationError(endpoint.error());
  return *std::move(endpoint);
}

std::uint32_t format_from(const std::string& words, const std::string& option) {
  const auto format = wire::format_from_words(words);
  if (!format) throw CLI::ValidationError(option + format.error());
  return *format;
}

endpoints::Preset preset_from(const std::string& name) {
  auto preset = endpoints::find_preset(name);
  if (!preset) throw CLI::ValidationError("--preset: " + preset.error());
  return *std::move(preset);
}

std::string is_svg(const std::string& path) {
  const bool fits = path.size() > 4 && path.substr(path.size() - 4) == ".svg";
  return fits ? std::string() : "\"" + path + "\": the name must end in .svg";
}

void write_whole_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) {
    throw std::runtime_error(path + ": cannot be written: " + base::system_text(errno));
  }
}

ExitCode run_program(CLI::App& app, int argc, const char* const* argv, const std::function<ExitCode()>& run) {
  base::open_standard_descriptors();
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
    return run();
  } catch (const CLI::Success& help) {
    app.exit(help);
    return exit_good;
  } catch (const CLI::ExtrasError&) {
    return report_usage(app, extras_error(app));
  } catch (const CLI::Error& error) {
    return report_usage(app, error.what());
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": error: " << error.what() << '\n';
    return exit_failed;
  }
}

}  // namespace trk_bridge::cli
