#include "crane_shot.h"
#include "node_main.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::nodes::CraneShot>(argc, argv, "crane_shot");
}
