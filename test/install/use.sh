# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# use.sh TEST_FOLDER: the installation below $PREFIX works alone, from PATH.
set -eu
PATH=$PREFIX/bin:$PATH
[ "$(command -v trk)" = "$PREFIX/bin/trk" ]
[ "$(trk --version)" = "trk $VERSION" ]
trk dump "file:$1/euler.trk?speed=0" --count 3 | wc -l | grep -qx 3
trk presets | grep -q disguise
grep -q '^.TH TRK 1' "$PREFIX/share/man/man1/trk.1"
bash --norc -c '. "$PREFIX/share/bash-completion/completions/trk"; complete -p trk' >/dev/null
head -n 1 "$PREFIX/share/zsh/site-functions/_trk" | grep -qx '#compdef trk'
# Programs and libraries use the libraries of this installation.
find "$PREFIX" -type f \( -name '*.so*' -o -perm -u+x \) | while read -r file; do
  case $(head -c 4 "$file" | tr -d '\0') in *ELF) ;; *) continue ;; esac
  ldd "$file" | awk -v prefix="$PREFIX/" -v file="$file" '
    /not found/ || (/libtrk/ && index($3, prefix) != 1) { print file ": " $0; bad = 1 } END { exit bad }'
done
