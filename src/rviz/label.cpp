#include "label.h"

namespace trk_bridge::rviz_display {

// The text cannot be made of nothing, nor of spaces alone.
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
