#include "origin.h"

#include <array>
#include <cstddef>
#include <string>

namespace trk_bridge::transport {
namespace {

constexpr std::size_t generations = 2, abis = 3, orders = 2;

std::size_t index_of(const wire::Layout& layout, bool guessed) noexcept {
  std::size_t index = static_cast<std::size_t>(layout.generation);
  index = index * abis + static_cast<std::size_t>(layout.abi);
  index = index * orders + static_cast<std::size_t>(layout.byte_order);
  return index * 2 + (guessed ? 1 : 0);
}

using Texts = std::array<std::string, generations * abis * orders * 2>;

/// As `layout=…` of a URL has it.
std::string word_of(const wire::Layout& layout) {
  std::string word = layout.generation == wire::Generation::document ? "document" : "identified";
  word += layout.abi == wire::Abi::lp64 ? "_lp64" : layout.abi == wire::Abi::llp64 ? "_llp64" : "_i386";
  return layout.byte_order == wire::ByteOrder::big ? word + "_be" : word;
}

Texts all_texts() {
  Texts texts;
  for (const auto generation : {wire::Generation::document, wire::Generation::identified}) {
    for (const auto abi : {wire::Abi::lp64, wire::Abi::llp64, wire::Abi::i386}) {
      for (const auto order : {wire::ByteOrder::little, wire::ByteOrder::big}) {
        for (const bool guessed : {false, true}) {
          const wire::Layout layout{generation, abi, order};
          texts[index_of(layout, guessed)] =
              "binary " + word_of(layout) + (guessed ? ", layout guessed" : "");
        }
      }
    }
  }
  return texts;
}

}  // namespace

const char* origin_of(const wire::WireForm& form, bool layout_guessed) noexcept {
  if (form.encoding == wire::Encoding::ascii) return "ASCII";
  static const Texts texts = all_texts();
  return texts[index_of(form.layout, layout_guessed)].c_str();
}

}  // namespace trk_bridge::transport
