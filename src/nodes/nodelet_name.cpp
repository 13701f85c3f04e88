// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "nodelet_name.h"

#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

namespace trk_bridge::nodes {
namespace {

struct Names {
  std::mutex mutex;
  std::condition_variable one_is_free;
  std::set<std::string> held;
};

Names& names() {
  static Names all;
  return all;
}

}  // namespace

NodeletName::NodeletName(std::string name, std::chrono::milliseconds longest_wait) : name_(std::move(name)) {
  std::unique_lock<std::mutex> lock(names().mutex);
  if (!names().one_is_free.wait_for(lock, longest_wait, [&] { return names().held.insert(name_).second; })) {
    throw std::runtime_error("the previous nodelet with this name has not ended yet");
  }
}

NodeletName::~NodeletName() {
  {
    const std::lock_guard<std::mutex> lock(names().mutex);
    names().held.erase(name_);
  }
  names().one_is_free.notify_all();
}

}  // namespace trk_bridge::nodes
