// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "endpoint_help.h"

#include "endpoints/schemes.h"

namespace trk_bridge::tools {
namespace {

using transport::Direction;

template <typename Options>
cli::HelpSection section(std::string title, const Options& options) {
  cli::HelpSection section{std::move(title), {}, {}};
  for (const auto& option : options) {
    section.entries.push_back(
        {std::string(option.key) + '=', std::string(option.help) + ". Allowed: " + std::string(option.allowed) + '.'});
  }
  return section;
}

}  // namespace

std::vector<cli::HelpSection> endpoint_help() {
  cli::HelpSection urls{"Endpoints",
                        "An endpoint is a URL, with options after a question mark: URL?KEY=VALUE&KEY=VALUE. %XX in "
                        "paths and values is the byte XX (hexadecimal). In a shell, put the URL in single quotes.",
                        {}};
  std::vector<cli::HelpSection> all;
  for (const auto* scheme : endpoints::schemes()) {
    urls.entries.push_back({std::string(scheme->usage), std::string(scheme->summary)});
    for (const auto direction : {Direction::read, Direction::write}) {
      const auto options = scheme->options(direction);
      if (options.empty()) continue;
      all.push_back(section("Options of " + std::string(scheme->name) + ", " + word(direction), options));
    }
  }
  all.insert(all.begin(), std::move(urls));
  all.push_back(section("Options of every endpoint that is written to", transport::form_options));
  return all;
}

std::vector<std::string> endpoint_prefixes() {
  std::vector<std::string> prefixes;
  for (const auto* scheme : endpoints::schemes()) prefixes.push_back(endpoints::prefix_of(*scheme));
  return prefixes;
}

}  // namespace trk_bridge::tools
