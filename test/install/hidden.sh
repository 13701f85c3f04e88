# hidden.sh FOLDER... -- COMMAND...: runs the command where the folders are empty. For a mount namespace of its own.
set -eu
while [ "$1" != -- ]; do
  mkdir -p "$1"  # one may lie in another
  mount -t tmpfs none "$1"
  shift
done
shift
cd /
exec "$@"
