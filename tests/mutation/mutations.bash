# Functions of run.bash and of patches_apply_test.sh. A mutation is a patch of the source with a head of three kinds of
# lines:
#   Bug:  what is planted
#   Seen: where such a bug was: a renderer's commit or issue, or our own history
#   Test: what is to notice, one line each: PROGRAM -tc=TEST CASES or -sf=SOURCE FILE (doctest's filters, to the end of the
#         line; commas count as part of a name), or: regress CASES of our own suite

# mutation_files FOLDER: its patches, in order.
mutation_files() { find "$1" -maxdepth 1 -name '*.patch' | LC_ALL=C sort; }

# field NAME PATCH: the lines of that name in its head.
field() { sed -n "/^--- /q; s/^$1: *//p" "$2"; }

# patch_tree FOLDER PATCH [OPTION]: applies it there exactly, or with -R takes it back. Wrong context is not forgiven.
patch_tree() {
  local folder=$1 file=$2
  shift 2
  patch --directory="$folder" --strip=1 --fuzz=0 --batch --silent --no-backup-if-mismatch --reject-file=- "$@" <"$file"
}

# program_of TEST, filter_of TEST: the two parts of a Test line.
program_of() { echo "${1%% *}"; }
filter_of() { echo "${1#* }"; }

# target_of TEST: what CMake builds for it.
target_of() {
  case $(program_of "$1") in
    regress) echo tyndall_cli ;;
    *) program_of "$1" ;;
  esac
}
