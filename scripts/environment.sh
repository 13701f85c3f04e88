# Sourced by the other scripts: where the project is, and an environment in which catkin finds the system's Python.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${TRK_BRIDGE_BUILD:-$root/build}
jobs=${TRK_BRIDGE_JOBS:-$(nproc)}

# Another Python first in PATH (pyenv, conda) has none of catkin's modules.
export PATH=/usr/bin:$PATH
unset PYTHONHOME PYTHONPATH

# A shell that has sourced our devel space already would make catkin write setup files that change nothing.
without_build() {
  printf %s "$1" | tr ':' '\n' | grep -v "^$build/" | paste -sd: || true
}
for variable in CMAKE_PREFIX_PATH LD_LIBRARY_PATH PATH PKG_CONFIG_PATH ROS_PACKAGE_PATH; do
  [ -n "${!variable:-}" ] || continue
  export "$variable=$(without_build "${!variable}")"
  [ -n "${!variable}" ] || unset "$variable"
done

# Noetic and ROS-O bring their own trees; Debian's packages are in /usr and need no set-up.
for distribution in noetic one; do
  [ -r "/opt/ros/$distribution/setup.bash" ] || continue
  set +u
  . "/opt/ros/$distribution/setup.bash"
  set -u
  break
done

# On Ubuntu 20.04 the default compiler is too old for the number parsing; take a newer one where there is one.
if [ -z "${CXX:-}" ] && ! echo '__GNUC__' | c++ -E -P -x c++ - 2>/dev/null | awk '{exit !($1 >= 11)}'; then
  for version in 13 12 11; do
    if command -v "g++-$version" >/dev/null; then
      export CC="gcc-$version" CXX="g++-$version"
      break
    fi
  done
fi

configure() {
  cmake -S "$root" -B "$build" -G Ninja \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 "$@"
}

# catkin's setup files read variables that may be unset.
enter_devel_space() {
  set +u
  . "$build/devel/setup.bash"
  set -u
}

# A UDP port of 127.0.0.1 that nobody receives on.
free_udp_port() {
  python3 -c 'import socket
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# A TCP port of 127.0.0.1 that nobody listens on.
free_tcp_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
