// How a record of trk was encoded, in words.
#pragma once

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// "ASCII", "binary identified_lp64", "binary document_i386_be", with ", layout guessed" behind it where two layouts
/// would have done. Static text.
const char* origin_of(const wire::WireForm&, bool layout_guessed = false) noexcept;

}  // namespace trk_bridge::transport
