#include "trk_bridge/transport/sink.h"

#include <system_error>

namespace trk_bridge::transport {

std::string describe(const SinkFault& fault) {
  switch (fault.reason) {
    case SinkReason::not_encodable:
      return "the record cannot be written: " + wire::describe(fault.fault);
    case SinkReason::no_constants:
      return "parameters came before the constants that a file begins with";
    case SinkReason::constants_changed:
      return "a file holds one set of constants, and others came after the first";
    case SinkReason::other_camera:
      return "a file holds one camera, and this record has another id than the constants in the file";
    case SinkReason::system:
      return "the system refused: " + std::generic_category().message(fault.error_number);
    case SinkReason::gone:
      return "the segment was removed; the next write makes it anew";
    case SinkReason::closed:
      return "the sink is closed";
  }
  return "unknown fault";
}

}  // namespace trk_bridge::transport
