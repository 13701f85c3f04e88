// Line segments in one colour, unlit.
#pragma once

#include <cstdint>
#include <vector>

#include <rviz/ogre_helpers/billboard_line.h>
#include <Eigen/Core>

#include "ogre_types.h"

namespace trk_bridge::rviz_display {

class Lines {
 public:
  Lines(Ogre::SceneManager* scene, Ogre::SceneNode* parent);

  /// Pairs of points, a segment each, in the parent's frame; `width` in m. None shows nothing.
  void show(const std::vector<Eigen::Vector3d>& pairs, const Ogre::ColourValue& colour, float width);
  void hide() { line_.clear(); }

  /// To be called before every frame: makes the lines as wide as they are for whoever looks at them from anywhere.
  void face_viewer();

 private:
  rviz::BillboardLine line_;
  float width_ = 0;
  std::uint32_t room_ = 0;  // for so many segments
};

}  // namespace trk_bridge::rviz_display
