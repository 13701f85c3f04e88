// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "option_text.h"

namespace trk_bridge::cli {

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> visible_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> dashed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back('-' + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string value_name(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  std::string words;
  for (const auto& word : value_words(option)) words += (words.empty() ? "" : "|") + word;
  return words.empty() ? option.get_type_name() : words;
}

std::vector<std::string> value_words(const CLI::Option& option) {
  // CLI::IsMember names them as TEXT:{A,B}.
  const std::string name = option.get_type_name();
  const std::size_t begin = name.find('{'), end = name.rfind('}');
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (const auto& word : CLI::detail::split(name.substr(begin + 1, end - begin - 1), ',')) words.push_back(word);
  return words;
}

bool takes_many(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

}  // namespace trk_bridge::cli
