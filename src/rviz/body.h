// A camera's body: a box behind the optical centre, the lens before it, a handle on top that tells which way is up.
#pragma once

#include <array>
#include <memory>

#include <rviz/ogre_helpers/shape.h>

#include "ogre_types.h"

namespace trk_bridge::rviz_display {

class Body {
 public:
  /// `optical` is a node in the optical frame: the lens ends in its origin.
  Body(Ogre::SceneManager* scene, Ogre::SceneNode* optical);

  /// `length` in m, from the lens to the end of the box.
  void show(const Ogre::ColourValue& colour, float length);
  void hide();

 private:
  ScopedSceneNode node_;
  Ogre::SceneNode* optical_;
  std::array<std::unique_ptr<rviz::Shape>, 4> shapes_;
};

}  // namespace trk_bridge::rviz_display
