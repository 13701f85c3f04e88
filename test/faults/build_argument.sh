# Sourced by scripts/faults and scripts/soak: the build that is entered is that of the argument --build, where it is given.

for ((i = 1; i < $#; i++)); do
  if [ "${!i}" = --build ]; then
    next=$((i + 1))
    build=$(cd "${!next}" && pwd)
  fi
done
