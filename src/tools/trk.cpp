// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trk: one tool for all endpoints.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include "base/nearest.h"
#include "cli/arguments.h"
#include "cli/checked_output.h"
#include "cli/completion.h"
#include "cli/exit_code.h"
#include "cli/manual.h"
#include "cli/option_text.h"
#include "cli/stop_signals.h"
#include "detect.h"
#include "detect_places.h"
#include "dump.h"
#include "endpoint_help.h"
#include "endpoints/presets.h"
#include "lens_table.h"
#include "monitor/monitor.h"
#include "preset_list.h"
#include "relay.h"
#ifdef TRK_BRIDGE_WITH_BAG
#include "bag/command.h"
#include "bag/delay_command.h"
#endif

namespace trk_bridge::tools {
namespace {

constexpr double default_field_rate = 50;  // Hz, of takes

bool is_regular_file(int fd) {
  struct stat there {};
  return ::fstat(fd, &there) == 0 && S_ISREG(there.st_mode);
}

void add_source(CLI::App& command, std::string& url) {
  command.footer(cli::endpoints_help());
  command.add_option("SOURCE", url, "The source of records")->required();
}

void add_seconds(CLI::App& command, std::optional<double>& seconds) {
  command.add_option("--seconds", seconds, "End after S seconds")->check(cli::positive_number())->type_name("S");
}

/// Opens the source, prints its name on standard error, and runs until a signal stops it.
template <typename Run>
cli::ExitCode run_with_source(const std::string& url, Run run) {
  const auto source = cli::source_from(url).open(default_field_rate);
  const cli::StopSignals signals(source.get());
  std::cerr << "trk: reading " << source->name() << '\n';
  return run(*source);
}

class DumpCommand {
 public:
  explicit DumpCommand(CLI::App& app)
      : command_(app.add_subcommand("dump", "Print what SOURCE receives, one record per line")) {
    add_source(*command_, url_);
    command_->add_flag("--json", options_.json, "One JSON object per line");
    command_->add_option("--count", options_.count, "End after N records")->check(cli::whole_number(1))->type_name("N");
    add_seconds(*command_, options_.seconds);
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() {
    options_.flush_each = !is_regular_file(STDOUT_FILENO);
    return run_with_source(url_,
                           [this](transport::Source& source) { return dump(source, options_, std::cout, std::cerr); });
  }

 private:
  CLI::App* command_;
  std::string url_;
  DumpOptions options_;
};

/// Throws if an id would be sent to a receiver that accepts none; the error is the id between the texts.
void check_id(const transport::SinkForm& form, const std::string& before, const std::string& after) {
  if (form.sends_id || form.id.value_or(0) == 0) return;
  throw CLI::ValidationError(before + std::to_string(*form.id) + after + " sends no id; only 0 is allowed");
}

class RelayCommand {
 public:
  explicit RelayCommand(CLI::App& app)
      : command_(app.add_subcommand("relay",
                                    "Pass on what SOURCE receives to every SINK: record, play, convert, distribute")) {
    command_->footer(cli::endpoints_help());
    command_->add_option("SOURCE", source_url_, "The source of records")->required();
    command_->add_option("SINK", sink_urls_, "Receivers of the records")->required()->expected(1, -1);
    auto* format = command_
                       ->add_option("--format", format_words_,
                                    "Format words, in quotes, for sinks whose URL sets no format; default: as received")
                       ->type_name("WORDS");
    command_->add_option("--preset", preset_name_, "The receiver, instead of format words: see trk presets")
        ->type_name("NAME")
        ->excludes(format);
    command_->add_option("--id", form_.id, "Camera id that replaces the received one, for sinks whose URL sets no id")
        ->check(cli::whole_number(0, std::numeric_limits<std::uint32_t>::max()))
        ->type_name("N");
    add_seconds(*command_, seconds_);
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() {
    if (format_words_) form_.format = cli::format_from(*format_words_);
    if (preset_name_) follow(cli::preset_from(*preset_name_));
    const auto from = cli::source_from(source_url_);
    std::vector<transport::SinkEndpoint> to;
    for (const auto& url : sink_urls_) to.push_back(checked(cli::sink_from(url, preset_name_.value_or(""))));

    const auto source = from.open(default_field_rate);
    FanOut sinks(std::cerr, from.can_wait ? [] { return !cli::StopSignals::stopped(); } : std::function<bool()>());
    for (const auto& endpoint : to) sinks.add(endpoint, form_);
    const cli::StopSignals signals(source.get());
    std::cerr << "trk: reading " << source->name() << '\n';
    for (const auto& outlet : sinks.outlets()) {
      const auto state = outlet->state();
      std::cerr << "trk: writing " << state.name << '\n';
      if (!state.notice.empty()) std::cerr << "trk: " << state.name << ": " << state.notice << '\n';
    }
    return relay(*source, sinks, seconds_);
  }

 private:
  void follow(const endpoints::Preset& preset) {
    form_.format = preset.format;
    form_.sends_id = preset.sends_id;
    check_id(form_, "--id ", ": the preset " + preset.name);
  }
  /// A URL may also set an id, or a preset without ids.
  transport::SinkEndpoint checked(transport::SinkEndpoint endpoint) const {
    check_id(transport::with_defaults(endpoint.form, form_), "endpoint \"" + endpoint.url + "\": id ",
             " with a preset that");
    return endpoint;
  }

  CLI::App* command_;
  std::string source_url_;
  std::vector<std::string> sink_urls_;
  std::optional<std::string> format_words_;
  std::optional<std::string> preset_name_;
  transport::SinkForm form_;
  std::optional<double> seconds_;
};

class MonitorCommand {
 public:
  explicit MonitorCommand(CLI::App& app)
      : command_(app.add_subcommand("monitor",
                                    "Show live what arrives from SOURCE, and its problems: on a terminal as a screen "
                                    "(? shows its keys, q ends it), else one line per second for every camera")) {
    add_source(*command_, url_);
    add_seconds(*command_, options_.seconds);
    command_
        ->add_option("--alarm", alarms_,
                     "Raise an alarm, such as 'loss>1%': bell, first line, exit code 4. Can be given several times. "
                     "Quantities: " +
                         monitor::alarm_quantities() + ", of the last seconds")
        ->allow_extra_args(false)
        ->type_name("LIMIT");
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() {
    for (const auto& text : alarms_) {
      const auto alarm = monitor::parse_alarm(text);
      if (!alarm) throw CLI::ValidationError("--alarm: " + alarm.error());
      options_.alarms.push_back(*alarm);
    }
    return run_with_source(url_, [this](transport::Source& source) {
      if (::isatty(STDOUT_FILENO) != 0) return monitor::show_on_screen(source, options_, std::cerr);
      return monitor::show_in_lines(source, options_, std::cout, std::cerr);
    });
  }

 private:
  CLI::App* command_;
  std::string url_;
  std::vector<std::string> alarms_;
  monitor::Options options_;
};

class DetectCommand {
 public:
  explicit DetectCommand(CLI::App& app)
      : command_(
            app.add_subcommand("detect", "Find out who sends tracking data to this machine, and how to receive it")) {
    command_->add_option("PORT", options_.places,
                         "Port to listen to, or GROUP:PORT; default: all usual ports and groups");
    command_->add_option("--seconds", options_.seconds, "Listen for S seconds")
        ->capture_default_str()
        ->check(cli::positive_number())
        ->type_name("S");
    auto* json = command_->add_flag("--json", options_.json, "A JSON object for each camera");
    command_->add_flag("--list", lists_, "List the usual ports and groups instead")->excludes(json);
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() const {
    if (!lists_) return detect(options_, std::cout, std::cerr);
    cli::CheckedOutput out(std::cout);
    for (const auto& line : usual_place_lines()) out.line(line, false);
    return out.finish(std::cerr);
  }

 private:
  CLI::App* command_;
  DetectOptions options_;
  bool lists_ = false;
};

class LensCommand {
 public:
  explicit LensCommand(CLI::App& app)
      : command_(app.add_subcommand("lens", "Check a lens table, which Free-D needs, and describe its content")) {
    command_->add_option("FILE.yaml", path_, "The table")->required();
    command_->add_option("--plot", plot_, "Plot focal length, centre shift and distortion over zoom")
        ->check(cli::is_svg)
        ->type_name("FILE.svg");
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() const {
    const auto table = lens::Table::load(path_);
    if (!table) throw std::runtime_error(table.error());
    cli::CheckedOutput out(std::cout);
    for (const auto& line : lines_of(**table)) out.line(line, false);
    if (plot_) cli::write_whole_file(*plot_, to_svg(**table, path_));
    return out.finish(std::cerr);
  }

 private:
  CLI::App* command_;
  std::string path_;
  std::optional<std::string> plot_;
};

class PresetsCommand {
 public:
  explicit PresetsCommand(CLI::App& app) : command_(app.add_subcommand("presets", "List the known receivers")) {
    command_->add_flag("--json", as_json_, "One JSON object per line");
  }
  bool is_asked_for() const { return command_->parsed(); }

  cli::ExitCode run() const {
    (as_json_ ? list_presets_as_json : list_presets)(endpoints::presets(), std::cout);
    return cli::CheckedOutput(std::cout).finish(std::cerr);
  }

 private:
  CLI::App* command_;
  bool as_json_ = false;
};

std::string version() { return TRK_BRIDGE_VERSION; }

/// Help on one topic, the manual page and completions, generated from what the program declares.
class HelpCommands {
 public:
  explicit HelpCommands(CLI::App& app)
      : app_(app),
        help_(app.add_subcommand("help", "Explain a command, or endpoints and their options")),
        completion_(app.add_subcommand("completion", "Print a completion script for a shell")),
        // For the build.
        manual_(app.add_subcommand("manual", "Print the manual page")->group("")) {
    help_->add_option("TOPIC", topic_, "A command, or endpoints");
    completion_->add_option("SHELL", shell_, "The shell")->required()->check(CLI::IsMember({"bash", "zsh"}));
  }
  bool is_asked_for() const { return help_->parsed() || completion_->parsed() || manual_->parsed(); }

  cli::ExitCode run() const {
    cli::CheckedOutput out(std::cout);
    std::string text = help_->parsed() ? help() : completion_->parsed() ? completion() : manual();
    while (!text.empty() && text.back() == '\n') text.pop_back();
    out.line(text, false);
    return out.finish(std::cerr);
  }

 private:
  std::vector<std::string> topics() const {
    std::vector<std::string> all{endpoints_topic};
    for (const auto* command : cli::visible_commands(app_)) all.push_back(command->get_name());
    return all;
  }
  std::string help() const {
    if (topic_.empty()) return app_.help();
    if (topic_ == endpoints_topic) return cli::plain_text(endpoint_help());
    const auto all = topics();
    if (std::find(all.begin(), all.end(), topic_) != all.end())
      return app_.get_subcommand(topic_)->help(app_.get_name());
    std::string known;
    for (const auto& topic : all) known += (known.empty() ? "" : ", ") + topic;
    const auto meant = base::likely(topic_, all);
    throw CLI::ValidationError("no help on \"" + topic_ + '"' +
                               (meant ? ", did you mean " + *meant + '?' : "; topics are " + known));
  }
  std::string completion() const {
    std::vector<std::string> presets;
    for (const auto& preset : endpoints::presets()) presets.push_back(preset.name);
    const auto urls = endpoint_prefixes();
    const cli::Completions known{{"SOURCE", urls}, {"SINK", urls}, {"--preset", presets}, {"TOPIC", topics()}};
    return shell_ == "bash" ? cli::bash_completion(app_, known) : cli::zsh_completion(app_, known);
  }
  std::string manual() const { return cli::manual_page(app_, version(), endpoint_help()); }

  static constexpr const char* endpoints_topic = "endpoints";

  const CLI::App& app_;
  CLI::App* help_;
  CLI::App* completion_;
  CLI::App* manual_;
  std::string topic_;
  std::string shell_;
};

}  // namespace
}  // namespace trk_bridge::tools

// Only declaring options is outside run_program; it throws only for errors in this program.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  using namespace trk_bridge;
  using namespace trk_bridge::tools;
  std::ios::sync_with_stdio(false);
  CLI::App app("Shows, records, plays and converts camera tracking data.", "trk");
  app.require_subcommand(1);
  app.set_version_flag("--version", "trk " + version(), "Print the version");
  DumpCommand dump_command(app);
  RelayCommand relay_command(app);
  MonitorCommand monitor_command(app);
  DetectCommand detect_command(app);
  LensCommand lens_command(app);
  PresetsCommand presets_command(app);
#ifdef TRK_BRIDGE_WITH_BAG
  bag::Command bag_command(app);
  bag::DelayCommand delay_command(app);
#endif
  const HelpCommands help_commands(app);
#ifndef TRK_BRIDGE_WITH_BAG
  app.footer("Built without ROS: trk bag and trk delay are not included.");
#endif
  return cli::run_program(app, argc, argv, [&] {
#ifdef TRK_BRIDGE_WITH_BAG
    if (bag_command.is_asked_for()) return bag_command.run();
    if (delay_command.is_asked_for()) return delay_command.run();
#endif
    if (help_commands.is_asked_for()) return help_commands.run();
    if (dump_command.is_asked_for()) return dump_command.run();
    if (relay_command.is_asked_for()) return relay_command.run();
    if (detect_command.is_asked_for()) return detect_command.run();
    if (lens_command.is_asked_for()) return lens_command.run();
    if (monitor_command.is_asked_for()) return monitor_command.run();
    return presets_command.run();
  });
}
