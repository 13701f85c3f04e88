#include "crane_shot.h"
#include "nodes/node.h"

int main(int argc, char** argv) {
  return trk_bridge::nodes::node_main<trk_bridge::demo::CraneShot>(argc, argv, "crane_shot");
}
