#!/usr/bin/env bash
# docs/cli.md says what --help says: every option of every command, with its default and its example.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN

# options COMMAND: a line for each of its options, as --help tells it.
options() {
  "$T" "$1" --help | awk '
    /^  -/ { if (line) print line; line = $0; next }
    /^                    / { if (line) line = line " " $0; next }
    { if (line) print line; line = "" }
    END { if (line) print line }' | tr -s ' ' | sed -E 's/ in \[[0-9]+ - [0-9]+\]//' | grep -v -- '--help'
}

# row COMMAND OPTION MANUAL: where the manual tells of it; methods and the like are told of once, under render.
row() {
  sed 's/`//g; s/²/^2/g' "$3" | awk -v command="$1" -v option="$2" '
    /^## / { here = $2 == command }
    /^\|/ { split($0, cell, "|"); if (("," cell[2] ",") ~ "[ ,]" option "[ ,]") { if (here) own = $0; if (render) other = $0 } }
    /^## / { render = $2 == "render" && command ~ /^(compare|farm|denoise|relight|matte|flatten)$/ }
    END { print own ? own : other }'
}

# compare_with MANUAL: what it lacks.
compare_with() {
  local command line option wanted found
  for command in render compare diff regress merge denoise relight matte flatten status farm example; do
    while read -r line; do
      option=$(sed -E 's/^ *([^ :=]*,)?(--[a-z-]+).*/\2/' <<<"$line")
      found=$(row "$command" "$option" "$1")
      [ -n "$found" ] || { echo "$command $option is not there"; continue; }
      for wanted in "$(sed -nE 's/.* \[([^]]*)\](;.*)?$/\1/p' <<<"$line")" "$(sed -nE 's/.*(\]; |example: )(.*)$/\2/p' <<<"$line")"; do
        [ -z "$wanted" ] || [ "$wanted" = none ] || grep -qF -- "$wanted" <<<"$found" || echo "$command $option does not say: $wanted"
      done
    done < <(options "$command")
  done
}

# Who types nothing but the name is told the commands.
expect 0 "$T"
mv out.txt bare.txt
expect 0 "$T" --help
cmp -s bare.txt out.txt || fail "without arguments something else is printed than by --help: $(head -c 300 bare.txt)"
says "  render " bare.txt

manual=$TYNDALL_SOURCE_DIR/docs/cli.md
[ "$(options render | wc -l)" -ge 25 ] || fail "--help cannot be read: $(options render | head -n 3)"
lacking=$(compare_with "$manual")
[ -z "$lacking" ] || fail "$lacking"

# It must notice what is planted.
grep -v -- '--sanitize' "$manual" >without.md
compare_with without.md | grep -q -- 'render --sanitize is not there' || fail "a missing option was not noticed"
sed 's/instead of `--time` | none/instead of `--time` | 7/; s/SCENE.exr/THERE.exr/; s/`--spp 256`/`--spp 255`/' "$manual" >other.md
compare_with other.md >lacking.txt
says "render --output does not say: the Film's name, else SCENE.exr" lacking.txt
says 'render --spp does not say: --spp 256' lacking.txt
finish
