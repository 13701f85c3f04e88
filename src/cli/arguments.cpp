#include "arguments.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "base/process.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::cli {

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
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

ExitCode run_program(CLI::App& app, int argc, const char* const* argv, const std::function<ExitCode()>& run) {
  base::open_standard_descriptors();
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::Success& help) {
    app.exit(help);
    return exit_good;
  } catch (const CLI::Error& error) {
    std::cerr << app.get_name() << ": error: " << error.what() << "\nRun with --help for more information.\n";
    return exit_usage;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": error: " << error.what() << '\n';
    return exit_failed;
  }
}

}  // namespace trk_bridge::cli
