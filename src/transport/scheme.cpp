#include "scheme.h"

#include <algorithm>

namespace trk_bridge::transport {
namespace {

const char* word(Direction direction) { return direction == Direction::read ? "reading" : "writing"; }

std::string joined(const std::vector<std::string_view>& keys) {
  std::string text;
  for (const auto key : keys) text += (text.empty() ? "" : ", ") + std::string(key);
  return text.empty() ? "none" : text;
}

}  // namespace

std::string unknown_option(const std::string& key, std::string_view scheme, Direction direction,
                                   const std::vector<std::string_view>& known,
                                   const std::vector<std::string_view>& other_way) {
  const auto in = [&key](const auto& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  auto all = known;
  if (direction == Direction::write) all.insert(all.end(), form_keys.begin(), form_keys.end());
  const std::string allowed = std::string(": ") + word(direction) + " " + std::string(scheme) + " knows " + joined(all);
  const bool is_for_other_way = in(other_way) || (direction == Direction::read && in(form_keys));
  if (!is_for_other_way) return "unknown option " + key + allowed;
  return "option " + key + " is for " + word(direction == Direction::read ? Direction::write : Direction::read) +
         allowed;
}

std::optional<double> real_number(std::string_view text, double lowest, double highest) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number >= lowest && number <= highest)) return {};
  return number;
}

bool assign_switch(const std::string& value, bool& to) {
  if (value != "0" && value != "1") return false;
  to = value == "1";
  return true;
}

bool assign_layout(const std::string& value, wire::LayoutChoice& to) {
  const auto choice = wire::layout_choice_from_word(value);
  if (choice) to = *choice;
  return choice.has_value();
}

SinkForm with_defaults(const SinkForm& given, const SinkForm& defaults) noexcept {
  SinkForm form = given.format ? given : defaults;
  form.id = given.id ? given.id : defaults.id;
  return form;
}

}  // namespace trk_bridge::transport
