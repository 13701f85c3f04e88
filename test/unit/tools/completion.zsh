# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Types into an interactive zsh that has loaded the completion script FILE: completion.zsh FILE. Prints the arguments of
# each call of a fake trk.
zmodload zsh/zpty
zpty terminal zsh -f -i
type() { zpty -w -n terminal $1$'\r' }
answer() {
  local line
  zpty -r terminal line "*got:*[[:cntrl:]]" || return
  print -r -- ${${line##*got:}%%[[:cntrl:]]*}
}
type "PS1=; unsetopt zle_bracketed_paste; autoload -Uz compinit; compinit -u -D; source $1; trk() { print -r -- got\":\$*\" }"
for line in $'trk du\t' $'trk dump --js\t' $'trk relay --pre\t' $'trk relay --preset pixo\t' $'trk dump op\t'; do
  type $line
  answer
done
zpty -d terminal
