# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of novelview for bash; zsh takes it after "autoload bashcompinit; bashcompinit".
# Commands, options and their choices are those that the program's own help names.

_novelview_choices() { # COMMAND OPTION: what its help states in "(a, b, c; default: d)"
  novelview "$1" --help 2>/dev/null |
    sed -n -e "/^ *\(.*,\)\{0,1\}$2[ ,{]/,/^  -/p" |
    sed -n -e 's/.*(\([^():;.]*, [^():;.]*\)\(; [^()]*\)\{0,1\})$/\1/p' | head -n 1 | tr -d ','
}

_novelview() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "--help --version $(novelview --help 2>/dev/null |
      sed -n -e '/^Subcommands:/,$s/^  \([a-z][a-z]*\) .*/\1/p')" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(novelview "$command" --help 2>/dev/null |
      sed -n -e 's/{[a-z]*}//g' -e 's/^  \(-[^ ]*\).*/\1/p' | tr ',' '\n')" -- "$word")
  elif [[ $before == --* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_novelview_choices "$command" "$before")" -- "$word")
  fi
  if [ ${#COMPREPLY[@]} -eq 0 ] && [[ $word != -* ]]; then
    compopt -o filenames 2>/dev/null || true # none runs in a test
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -F _novelview novelview
