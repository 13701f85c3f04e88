// How a camera is to be drawn.
#pragma once

#include <string>

#include <OgreColourValue.h>

namespace trk_bridge::rviz_display {

/// Lengths and line widths in m, colours with their alpha.
struct FigureStyle {
  struct Frustum {
    bool on = true;
    Ogre::ColourValue colour;
    double near = 0.2, far = 3;  ///< not drawn unless near < far
  } frustum;
  /// Outline in full colour, the area within with the colour's alpha.
  struct ImagePlane {
    bool on = true;
    Ogre::ColourValue colour;
    double distance = 1;
    bool undistorted = true;  ///< the pinhole's outline, too, dashed
  } image_plane;
  struct FocusPlane {
    bool on = true;
    Ogre::ColourValue colour;
  } focus_plane;
  struct OpticalAxis {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 4;
  } axis;
  struct Body {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 0.4;
  } body;
  struct Text {
    bool on = true;
    Ogre::ColourValue colour;
    double height = 0.2;
  } name, values;
  struct Trail {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 5;  ///< seconds
    double line_width = 0.01;
  } trail;
  double line_width = 0.01;  ///< of all but the trail
};

}  // namespace trk_bridge::rviz_display
