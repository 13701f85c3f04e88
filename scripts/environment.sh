# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Sourced by the other scripts: paths of the project, and an environment in which catkin finds the Python of the system.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${TRK_BRIDGE_BUILD:-$root/build}
jobs=${TRK_BRIDGE_JOBS:-$(nproc)}

# Another Python that is first in PATH (pyenv, conda) does not have the modules of catkin.
export PATH=/usr/bin:$PATH
unset PYTHONHOME PYTHONPATH

# In a shell that has sourced our devel space already, catkin would write setup files without effect.
without_build() {
  printf %s "$1" | tr ':' '\n' | grep -v "^$build/" | paste -sd: || true
}
for variable in CMAKE_PREFIX_PATH LD_LIBRARY_PATH PATH PKG_CONFIG_PATH ROS_PACKAGE_PATH; do
  [ -n "${!variable:-}" ] || continue
  export "$variable=$(without_build "${!variable}")"
  [ -n "${!variable}" ] || unset "$variable"
done

# Noetic and ROS-O have their own trees; the packages of Debian are in /usr and need no setup.
for distribution in noetic one; do
  [ -r "/opt/ros/$distribution/setup.bash" ] || continue
  set +u
  . "/opt/ros/$distribution/setup.bash"
  set -u
  break
done

# On Ubuntu 20.04 the default compiler is too old for the number parsing; use a newer one if it is installed.
if [ -z "${CXX:-}" ] && ! echo '__GNUC__' | c++ -E -P -x c++ - 2>/dev/null | awk '{exit !($1 >= 11)}'; then
  for version in 13 12 11; do
    if command -v "g++-$version" >/dev/null; then
      export CC="gcc-$version" CXX="g++-$version"
      break
    fi
  done
fi

# The files of a target are compiled together (unity build): a complete build takes less than half of the time.
configure() {
  cmake -S "$root" -B "$build" -G Ninja -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 "$@"
}

# Configures a folder beside the build for another purpose: each file is compiled alone, and there are no tests. rosrun
# goes on finding the programs that it found before.
configure_separately() {
  local link status=0
  link=$(readlink "$root/.rosrun") || link=
  configure -DCMAKE_UNITY_BUILD=OFF -DTRK_BRIDGE_TESTS=OFF "$@" || status=$?
  if [ -n "$link" ]; then ln -sfn "$link" "$root/.rosrun"; else rm -f "$root/.rosrun"; fi
  return "$status"
}

# The setup files of catkin read variables that may be unset.
enter_devel_space() {
  set +u
  . "$build/devel/setup.bash"
  set -u
}

# ctest in the build, with its arguments. Tests wait more than they compute: three at a time for each processor.
# Nodes of the tests must find each other on a machine that cannot resolve its name.
run_tests() {
  enter_devel_space
  export ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
  (cd "$build" && ctest -j "$((jobs * 3))" --output-on-failure "$@")
}

# A free UDP port of 127.0.0.1.
free_udp_port() {
  python3 -c 'import socket
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# A free TCP port of 127.0.0.1.
free_tcp_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
