#include "faults.h"

#include <cctype>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::ros1 {
namespace {

bool is_base_name(const std::string& name) {
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) return false;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
  }
  return true;
}

bool is_frame(const std::string& frame) {
  if (frame.empty() || frame[0] == '/') return false;
  for (const char c : frame) {
    if (std::isspace(static_cast<unsigned char>(c)) != 0) return false;
  }
  return true;
}

}  // namespace

std::string quoted(const std::string& text) { return '\'' + text + '\''; }

void check_name(const std::string& name, Faults& faults) {
  if (is_base_name(name)) return;
  faults.add("name", quoted(name), "a camera's name must begin with a letter, then letters, digits and _");
}

bool check_frame(const char* key, const std::string& frame, Faults& faults) {
  const bool sound = is_frame(frame);
  if (!sound) faults.add(key, quoted(frame), "must be a tf frame: not empty, no leading slash, no white space");
  return sound;
}

void check_constants(const wire::CameraConstants& constants, Faults& faults) {
  const auto sound = camera::check(constants);
  if (!sound) faults.add("constants", "{…}", camera::describe(sound.error()));
}

void check_queue_size(int queue_size, Faults& faults) {
  if (queue_size >= 1 && queue_size <= 100000) return;
  faults.add("queue_size", std::to_string(queue_size), "must be 1 to 100000");
}

}  // namespace trk_bridge::ros1
