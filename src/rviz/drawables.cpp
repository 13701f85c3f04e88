// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "drawables.h"

#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>

namespace trk_bridge::rviz_display {
namespace {

Ogre::MaterialPtr make_material() {
  static unsigned count = 0;  // scenes are for one thread
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "trk_bridge area " + std::to_string(count++), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->setLightingEnabled(false);
  material->setCullingMode(Ogre::CULL_NONE);
  material->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  material->setDepthWriteEnabled(false);
  return material;
}

/// In the optical frame, for a body with length 1.
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

Area::Area(Ogre::SceneManager* scene, Ogre::SceneNode* parent)
    : scene_(scene), material_(make_material()), object_(scene->createManualObject()) {
  object_->setDynamic(true);
  parent->attachObject(object_);
}

Area::~Area() {
  scene_->destroyManualObject(object_);
  Ogre::MaterialManager::getSingleton().remove(material_->getHandle());
}

void Area::show(const std::vector<Eigen::Vector3d>& triangles, const Ogre::ColourValue& colour) {
  object_->clear();
  if (triangles.size() < 3) return;
  object_->estimateVertexCount(triangles.size());
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, material_->getGroup());
  for (const auto& point : triangles) {
    object_->position(to_ogre(point));
    object_->colour(colour);
  }
  object_->end();
}

Lines::Lines(Ogre::SceneManager* scene, Ogre::SceneNode* parent) : line_(scene, parent) {
  line_.setMaxPointsPerLine(2);
}

void Lines::show(const std::vector<Eigen::Vector3d>& pairs, const Ogre::ColourValue& colour, float width) {
  line_.clear();
  const std::size_t segments = pairs.size() / 2;
  if (segments == 0) return;
  if (segments > room_) {
    room_ = static_cast<std::uint32_t>(segments + segments / 2);
    line_.setNumLines(room_);
  }
  width_ = width;
  line_.setLineWidth(width);
  line_.setColor(colour.r, colour.g, colour.b, colour.a);
  for (std::size_t i = 0; i < segments; ++i) {
    if (i > 0) line_.newLine();
    line_.addPoint(to_ogre(pairs[2 * i]));
    line_.addPoint(to_ogre(pairs[2 * i + 1]));
  }
}

void Lines::face_viewer() {
  // Ogre turns a chain to its camera only when the chain has changed, not when node or camera have moved.
  line_.setLineWidth(width_);
}

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
    // rviz has only one light, from the viewer: faces parallel to the view would be black.
    shape->getMaterial()->setSelfIllumination(colour * 0.35f);
  }
  node_->setScale(length, length, length);
  if (node_->getParentSceneNode() == nullptr) optical_->addChild(node_.get());
}

void Body::hide() {
  if (node_->getParentSceneNode() != nullptr) optical_->removeChild(node_.get());
}

// MovableText does not accept an empty text, or only spaces.
Label::Label(Ogre::SceneNode* parent, Side side) : node_(make_node(parent)), side_(side), text_("-") {
  text_.setTextAlignment(rviz::MovableText::H_CENTER,
                         side == Side::above ? rviz::MovableText::V_ABOVE : rviz::MovableText::V_BELOW);
  text_.showOnTop();
  text_.setVisible(false);
  node_->attachObject(&text_);
}

void Label::show(const std::string& text, const Ogre::ColourValue& colour, float height, float distance) {
  if (text.find_first_not_of(" \t\n") == std::string::npos) {
    hide();
    return;
  }
  text_.setCaption(text);
  text_.setColor(colour);
  text_.setCharacterHeight(height);
  text_.setLineSpacing(height * 0.25f);
  text_.setSpaceWidth(height * 0.3f);
  text_.setGlobalTranslation({0, 0, side_ == Side::above ? distance : -distance});
  text_.setVisible(true);
}

}  // namespace trk_bridge::rviz_display
