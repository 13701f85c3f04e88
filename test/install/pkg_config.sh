# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# pkg_config.sh TEST_FOLDER PLACE: programs compile, link and run with only the flags of pkg-config.
set -eu
consumer=$1/consumer
cd "$2"
PKG_CONFIG_PATH=$(dirname "$(find "$PREFIX" -name trk_bridge.pc)")
export PKG_CONFIG_PATH
[ "$(pkg-config --modversion trk_bridge)" = "$VERSION" ]
library_path=$(pkg-config --variable=libdir trk_bridge)
for library in trk trk_identified; do
  # shellcheck disable=SC2046  # several words
  "$CC" -o "pc_$library" "$consumer/reads_in_c.c" $(pkg-config --cflags --libs "$library")
  LD_LIBRARY_PATH=$library_path "./pc_$library"
done
for program in converts opens; do
  # shellcheck disable=SC2046
  "$CXX" -std=c++17 -o "pc_$program" "$consumer/$program.cpp" $(pkg-config --cflags --libs trk_bridge)
  LD_LIBRARY_PATH=$library_path "./pc_$program"
done
