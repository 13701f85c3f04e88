// demo_crane: a camera crane in motion, sent to any endpoints.
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "arguments.h"
#include "crane_move.h"
#include "fan_out.h"
#include "stop_signals.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::tools {
namespace {

constexpr std::int64_t billion = 1'000'000'000;

struct CraneOptions {
  std::vector<std::string> sinks;
  std::optional<double> seconds;
  double rate = 50.0;
  std::string format_words = "euler";
  std::uint32_t id = 0;
};

std::int64_t monotonic_now() {
  timespec now{};
  if (::clock_gettime(CLOCK_MONOTONIC, &now) != 0) throw std::system_error(errno, std::generic_category(), "the clock");
  return now.tv_sec * billion + now.tv_nsec;
}

/// False when a signal came before.
bool sleep_until(std::int64_t nanoseconds) {
  const timespec until{static_cast<time_t>(nanoseconds / billion), static_cast<long>(nanoseconds % billion)};
  const int error = ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  if (error == 0) return true;
  if (error == EINTR) return !StopSignals::stopped();
  throw std::system_error(error, std::generic_category(), "waiting");
}

wire::CameraParams params_of(const CraneOptions& options, std::uint32_t format, const wire::CameraConstants& constants,
                             std::uint64_t field) {
  const auto encoded = camera::encode(crane_camera(static_cast<double>(field) / options.rate), format, &constants);
  if (!encoded) throw std::runtime_error("the crane's camera in this format: " + camera::describe(encoded.error()));
  wire::CameraParams params = *encoded;
  params.id = options.id;
  params.counter = field + 1;
  return params;
}

ExitCode run_crane(const CraneOptions& options) {
  const std::uint32_t format = format_of(options.format_words);
  std::vector<transport::Endpoint> endpoints;
  for (const auto& url : options.sinks) endpoints.push_back(endpoint_of(url, transport::Direction::write));
  std::vector<std::unique_ptr<transport::Sink>> sinks;
  for (const auto& endpoint : endpoints) sinks.push_back(transport::open_sink(endpoint));

  for (const auto& sink : sinks) std::cerr << "demo_crane: writing " << sink->name() << '\n';
  const StopSignals signals;
  FanOut out(std::move(sinks), "demo_crane", std::cerr);
  auto constants = camera::constants_for(crane_constants(), format);
  constants.id = options.id;
  out.write(constants);

  const double fields =
      options.seconds ? std::ceil(*options.seconds * options.rate) : std::numeric_limits<double>::infinity();
  const std::int64_t begin = monotonic_now();
  for (std::uint64_t field = 0; static_cast<double>(field) < fields && !StopSignals::stopped(); ++field) {
    const auto ahead = static_cast<std::int64_t>(static_cast<long double>(field) * 1e9L / options.rate);
    if (!sleep_until(begin + ahead)) break;
    out.write(params_of(options, format, constants, field));
  }
  out.close();
  out.summarise();
  return out.is_good() ? exit_good : exit_failed;
}

}  // namespace
}  // namespace trk_bridge::tools

int main(int argc, char** argv) {
  using namespace trk_bridge::tools;
  CLI::App app("Sends the tracking data of a synthetic camera crane to every SINK.", "demo_crane");
  app.footer(endpoints_help);
  CraneOptions options;
  app.add_option("SINK", options.sinks, "Where records go")->required()->expected(1, -1);
  app.add_option("--seconds", options.seconds, "End after S seconds; default: at SIGINT or SIGTERM")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  app.add_option("--rate", options.rate, "Video fields a second")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 10000.0))
      ->type_name("HZ");
  app.add_option("--format", options.format_words, "Format words, in quotes")
      ->capture_default_str()
      ->type_name("WORDS");
  app.add_option("--id", options.id, "Camera number; 0: not given")->capture_default_str()->type_name("N");
  return run_program(app, argc, argv, [&] { return run_crane(options); });
}
