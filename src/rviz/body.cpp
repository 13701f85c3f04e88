#include "body.h"

#include <OgreMaterial.h>

namespace trk_bridge::rviz_display {
namespace {

/// In the optical frame, for a body of length 1.
struct Part {
  rviz::Shape::Type type;
  Eigen::Vector3d center, size;
};
constexpr double lens_length = 0.4;

std::array<Part, 4> parts() {
  const double box = 1 - lens_length;
  const double middle = -lens_length - box / 2;
  return {{{rviz::Shape::Cube, {0, 0, middle}, {0.3, 0.4, box}},
           {rviz::Shape::Cylinder, {0, 0, -lens_length / 2}, {0.28, lens_length, 0.28}},
           {rviz::Shape::Cube, {0, -0.32, middle}, {0.07, 0.06, box * 0.8}},
           {rviz::Shape::Cube, {0, -0.245, middle + 0.2}, {0.07, 0.09, 0.06}}}};
}

}  // namespace

Body::Body(Ogre::SceneManager* scene, Ogre::SceneNode* optical) : node_(make_node(optical)), optical_(optical) {
  const auto drawn = parts();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    shapes_[i] = std::make_unique<rviz::Shape>(drawn[i].type, scene, node_.get());
    shapes_[i]->setPosition(to_ogre(drawn[i].center));
    shapes_[i]->setScale(to_ogre(drawn[i].size));
    if (drawn[i].type == rviz::Shape::Cylinder) {
      // Its axis is y.
      shapes_[i]->setOrientation(Ogre::Quaternion(Ogre::Degree(90), Ogre::Vector3::UNIT_X));
    }
  }
  hide();
}

void Body::show(const Ogre::ColourValue& colour, float length) {
  for (const auto& shape : shapes_) {
    shape->setColor(colour.r, colour.g, colour.b, colour.a);
    // rviz has but one light, from the viewer: sides along the view would be black.
    shape->getMaterial()->setSelfIllumination(colour * 0.35f);
  }
  node_->setScale(length, length, length);
  if (node_->getParentSceneNode() == nullptr) optical_->addChild(node_.get());
}

void Body::hide() {
  if (node_->getParentSceneNode() != nullptr) optical_->removeChild(node_.get());
}

}  // namespace trk_bridge::rviz_display
