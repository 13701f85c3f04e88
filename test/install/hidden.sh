# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# hidden.sh FOLDER... -- COMMAND...: runs the command while the folders look empty. To be called in a private mount
# namespace.
set -eu
while [ "$1" != -- ]; do
  mkdir -p "$1"  # one may be in another
  mount -t tmpfs none "$1"
  shift
done
shift
cd /
exec "$@"
