#include "trk_net.h"

int main(void) {
  trkCameraParams params;
  return trkNetReadParams(0, &params) == trkInvalidHandle ? 0 : 1;
}
