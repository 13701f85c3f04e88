// A filled area in one colour, unlit, seen from both sides.
#pragma once

#include <vector>

#include <OgreManualObject.h>
#include <OgreMaterial.h>
#include <Eigen/Core>

#include "ogre_types.h"

namespace trk_bridge::rviz_display {

class Area {
 public:
  Area(Ogre::SceneManager* scene, Ogre::SceneNode* parent);
  ~Area();
  Area(const Area&) = delete;
  Area& operator=(const Area&) = delete;

  /// Three points a triangle, in the parent's frame. None shows nothing.
  void show(const std::vector<Eigen::Vector3d>& triangles, const Ogre::ColourValue& colour);
  void hide() { object_->clear(); }

 private:
  Ogre::SceneManager* scene_;
  Ogre::MaterialPtr material_;
  Ogre::ManualObject* object_;
};

}  // namespace trk_bridge::rviz_display
