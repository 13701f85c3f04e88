#include "lines.h"

namespace trk_bridge::rviz_display {

Lines::Lines(Ogre::SceneManager* scene, Ogre::SceneNode* parent) : line_(scene, parent) {
  line_.setMaxPointsPerLine(2);
}

void Lines::show(const std::vector<Eigen::Vector3d>& pairs, const Ogre::ColourValue& colour, float width) {
  line_.clear();
  const auto segments = static_cast<std::uint32_t>(pairs.size() / 2);
  if (segments == 0) return;
  if (segments > room_) {
    room_ = segments + segments / 2;
    line_.setNumLines(room_);
  }
  width_ = width;
  line_.setLineWidth(width);
  line_.setColor(colour.r, colour.g, colour.b, colour.a);
  for (std::uint32_t i = 0; i < segments; ++i) {
    if (i > 0) line_.newLine();
    line_.addPoint(to_ogre(pairs[2 * i]));
    line_.addPoint(to_ogre(pairs[2 * i + 1]));
  }
}

void Lines::face_viewer() {
  // Ogre turns a chain to its camera only when the chain itself has changed, not when node or camera have moved.
  line_.setLineWidth(width_);
}

}  // namespace trk_bridge::rviz_display
