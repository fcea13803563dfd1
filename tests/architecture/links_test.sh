#!/usr/bin/env bash
# The documentation holds together: every relative link and image leads to a file that is there, and to a heading of it if the link
# names one; README is at most 800 words; every file in docs can be reached from README.
# Usage: links_test.sh [CHECKOUT]
set -u
export LC_ALL=C
here=$(cd "${1:-$(dirname "$0")/../..}" && pwd)
most_words=800

# Lines "DOCUMENT TAB LINK" of [text](link), ![text](link), src="link", href="link" and [name]: link outside of code; other sites left out.
links() {
  awk '
    function take(pattern, head, tail,    rest) {
      for (rest = $0; match(rest, pattern); rest = substr(rest, RSTART + RLENGTH)) give(substr(rest, RSTART + head, RLENGTH - head - tail))
    }
    function give(link) { if (link !~ /^[a-z]+:/) print FILENAME "\t" link }
    FNR == 1 { code = 0 }
    /^ *(```|~~~)/ { code = !code; next }
    code { next }
    { gsub(/`[^`]*`/, "code"); take("\\]\\([^) ]+", 2, 0); take("src=\"[^\"]+\"", 5, 1); take("href=\"[^\"]+\"", 6, 1) }
    /^\[[^]]+\]: / { give($2) }' "$@"
}

# Lines "DOCUMENT#HEADING", as links name headings.
headings() {
  awk '
    FNR == 1 { code = 0 }
    /^ *(```|~~~)/ { code = !code; next }
    !code && /^#+ / {
      sub(/^#+ +/, ""); sub(/ +$/, ""); gsub(/\]\([^)]*\)/, "")
      name = tolower($0)
      gsub(/[^a-z0-9 _-]/, "", name); gsub(/ /, "-", name)
      count = seen[FILENAME, name]++
      print FILENAME "#" name (count ? "-" count : "")
    }' "$@"
}

# target_of DOCUMENT LINK: sets `target` to the file that it leads to, from the root. Fails where it leads out.
target_of() {
  local path=${2%%#*} part
  [ -n "$path" ] || { target=$1; return; }
  [[ $path != /* ]] || return 1
  [[ $1 != */* ]] || path=${1%/*}/$path
  local -a parts=() steps
  IFS=/ read -ra steps <<<"$path"
  for part in "${steps[@]}"; do
    case $part in
      '' | .) ;;
      ..) [ ${#parts[@]} -gt 0 ] || return 1; unset 'parts[-1]' ;;
      *) parts+=("$part") ;;
    esac
  done
  local IFS=/
  target="${parts[*]}"
}

# check ROOT: prints what is wrong.
check() (
  cd "$1" || exit 1
  documents=(README.md CONTRIBUTING.md CHANGELOG.md docs/*.md tests/README.md volumes/*.md volumes/*/*.md)
  declare -A heading reached=([README.md]=1) leads_to
  while read -r name; do heading[$name]=1; done < <(headings "${documents[@]}" tests/regression/*/README.md)

  while IFS=$'\t' read -r document link; do
    if ! target_of "$document" "$link" || ! [ -e "${target:-.}" ]; then
      echo "$document: $link leads nowhere"
      continue
    fi
    [[ $link != *'#'* || -n ${heading[$target#${link#*#}]:-} ]] || echo "$document: $link names no heading of $target"
    [[ $target != *.md ]] || leads_to[$document]+=" $target"
  done < <(links "${documents[@]}")

  waiting=(README.md)
  while [ ${#waiting[@]} -gt 0 ]; do
    document=${waiting[0]}
    waiting=("${waiting[@]:1}")
    for target in ${leads_to[$document]:-}; do
      [ -z "${reached[$target]:-}" ] || continue
      reached[$target]=1
      waiting+=("$target")
    done
  done
  for document in docs/*.md; do
    [ -n "${reached[$document]:-}" ] || echo "$document cannot be reached from README.md"
  done

  words=$(wc -w <README.md)
  [ "$words" -le "$most_words" ] || echo "README.md has $words words, more than $most_words"
)

found=$(check "$here")
[ -z "$found" ] || { echo "$found"; exit 1; }
[ $# -eq 0 ] || exit 0

# It must notice what is planted in a copy.
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
ln -s "$here"/* "$copy"
failures=0

plant() {  # FILE TEXT: at its end, and nowhere else
  rm -rf "$copy/docs" "$copy/README.md"
  cp -r "$here/docs" "$here/README.md" "$copy"
  printf '\n%s\n' "$2" >>"$copy/$1"
}
must_notice() {  # WHAT FILE TEXT
  plant "$2" "$3"
  check "$copy" | grep -qF -- "$1" || { echo "was not noticed: $1"; failures=1; }
}
must_notice 'docs/cli.md: gone.md leads nowhere' docs/cli.md 'See [this](gone.md).'
must_notice 'docs/cli.md: pictures/gone.jpg leads nowhere' docs/cli.md '![A picture](pictures/gone.jpg)'
must_notice 'README.md: docs/gone.jpg leads nowhere' README.md '[![A picture](docs/gone.jpg)](docs/cli.md)'
must_notice 'README.md: docs/gone.png leads nowhere' README.md '<img width="240" src="docs/gone.png">'
must_notice 'docs/cli.md: /docs/cli.md leads nowhere' docs/cli.md '[absolute](/docs/cli.md)'
must_notice 'docs/cli.md: ../../outside leads nowhere' docs/cli.md '[outside](../../outside)'
must_notice 'docs/cli.md: #no-such-heading names no heading' docs/cli.md '[below](#no-such-heading)'
must_notice 'docs/cli.md: scenes.md#no-such-heading names no heading' docs/cli.md '[there](scenes.md#no-such-heading)'
must_notice 'docs/lonely.md cannot be reached' docs/lonely.md '# Lonely'
must_notice 'README.md has ' README.md "$(yes word | head -n "$most_words")"

# And complain of nothing else.
plant docs/cli.md "$(printf '%s\n' '```' '[code](gone.md)' '```' '`[code](gone.md)` [elsewhere](https://example.org/gone)')"
found=$(check "$copy")
[ -z "$found" ] || { echo "complains of what is right: $found"; failures=1; }
exit $failures
