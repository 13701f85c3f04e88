// How long a test waits.
#pragma once

#include <chrono>

namespace trk_bridge::test {

/// How long anything that has to happen may take. It only guards against waiting for ever: no test that passes waits as
/// long, also on a machine that is busy with other things.
inline constexpr std::chrono::seconds deadline{60};

}  // namespace trk_bridge::test
