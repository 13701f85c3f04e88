// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The error message that a test expects.
#pragma once

#include <string>

namespace trk_bridge::test {

/// The message of the `Error` that `work` throws; "no error" if it throws nothing. Other exceptions are not caught.
template <typename Error, typename Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace trk_bridge::test
