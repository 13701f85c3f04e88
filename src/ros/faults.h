// Faults of parameters under the keys that a user wrote, and what several nodes ask of theirs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

class Faults {
 public:
  explicit Faults(std::string path) : path_(std::move(path)) {}

  void add(const std::string& key, const std::string& value, const std::string& allowed) {
    lines.push_back(path_ + key + " = " + value + ": " + allowed);
  }

  std::vector<std::string> lines;

 private:
  std::string path_;
};

std::string quoted(const std::string& text);

/// A camera's name.
void check_name(const std::string& name, Faults& faults);
/// Whether it is sound.
bool check_frame(const char* key, const std::string& frame, Faults& faults);
void check_constants(const wire::CameraConstants& constants, Faults& faults);
void check_queue_size(int queue_size, Faults& faults);

}  // namespace trk_bridge::ros1
