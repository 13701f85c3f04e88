#include "trk_bridge/transport/fault.h"

namespace trk_bridge::transport {
namespace {

std::string describe_wire(const Fault& fault) {
  wire::Fault of_wire{static_cast<wire::Reason>(fault.code())};
  of_wire.about_field = fault.field() >= 0;
  if (of_wire.about_field) of_wire.field = static_cast<std::uint8_t>(fault.field());
  return wire::describe(of_wire);
}

}  // namespace

Fault::Fault(const wire::Fault& fault) noexcept
    : Fault(wire::name(fault.reason), describe_wire, static_cast<std::uint8_t>(fault.reason),
            fault.about_field ? std::int16_t{fault.field} : std::int16_t{-1}) {}

}  // namespace trk_bridge::transport
