// Words in the scene that face the viewer.
#pragma once

#include <string>

#include <rviz/ogre_helpers/movable_text.h>

#include "ogre_types.h"

namespace trk_bridge::rviz_display {

class Label {
 public:
  enum class Side { above, below };
  /// Stands above or below the node's origin, on top of whatever is in front of it.
  Label(Ogre::SceneNode* parent, Side side);

  /// UTF-8; `height` of a capital letter and `distance` from the origin, up or down in the fixed frame, in m.
  void show(const std::string& text, const Ogre::ColourValue& colour, float height, float distance);
  void hide() { text_.setVisible(false); }

 private:
  ScopedSceneNode node_;
  Side side_;
  rviz::MovableText text_;
};

}  // namespace trk_bridge::rviz_display
