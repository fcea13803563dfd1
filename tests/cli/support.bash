# What the scripts share. Each runs in a scratch folder of its own with TYNDALL_BIN and TYNDALL_SOURCE_DIR set.
set -u
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# expect CODE COMMAND...: runs the command; its output is in out.txt and err.txt.
expect() {
  local code=$1
  shift
  "$@" >out.txt 2>err.txt
  local got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $* ($(head -c 300 err.txt))"
}

# says TEXT FILE: the file holds the text.
says() { grep -qF -- "$1" "$2" || fail "\"$1\" is not in $2: $(head -c 300 "$2")"; }

# soon COMMAND...: waits until it succeeds. A slow machine, or a busy one, may need minutes.
soon() {
  local end=$((SECONDS + 300))
  until "$@" >/dev/null 2>&1; do
    [ $SECONDS -lt $end ] || { fail "in five minutes there was no: $*"; return 1; }
    sleep 0.02
  done
}

# interrupted SIGNAL WHEN COMMAND...: sends the signal to the command, which must not end before, once WHEN, which is evaluated,
# succeeds. Its exit code is in `code`, its output in out.txt and err.txt.
interrupted() {
  local signal=$1 when=$2
  shift 2
  : >err.txt  # or WHEN may see that of an earlier command
  "$@" >out.txt 2>err.txt &
  local pid=$!
  soon eval "$when || ! kill -0 $pid"
  kill -s "$signal" $pid 2>/dev/null || fail "ended by itself: $* ($(head -c 300 err.txt))"
  code=0
  wait $pid 2>/dev/null || code=$?
}

# rendering [SAMPLES]: a render with --progress json told in err.txt that it has more samples a pixel than that, or than none.
rendering() { grep -oE '"samples":[0-9]+' err.txt | awk -F: -v than="${1-0}" '$2 > than { found = 1 } END { exit !found }'; }

# samples_of IMAGE: a pixel, as its header tells.
samples_of() { "$TYNDALL_BIN" info "$1" | sed -n 's/.*tyndall\/samples *//p'; }

# broken_off OUTPUT OPTION...: a render without end is killed, resumed and interrupted.
broken_off() {
  local output=$1
  shift
  local endless=("$TYNDALL_BIN" render "$@" --spp 1000000 --checkpoint 0.05 --reproducible --progress json -o "$output")
  rm -f "$output.checkpoint"
  interrupted KILL "test -s $output.checkpoint" "${endless[@]}"
  interrupted INT rendering "${endless[@]}" --resume
  [ $code = 130 ] || fail "an interrupted render does not exit with 130: $(cat err.txt)"
  says 'going on from' err.txt
}

# sanitized: the program has sanitizers in it, which make it ten times as slow.
sanitized() { grep -qE '__(asan|tsan)_init' "$TYNDALL_BIN"; }

finish() { [ "$failures" = 0 ] && echo "ok" || exit 1; }

# lit_floor WIDTH HEIGHT SPP: a scene of a floor under a point light.
lit_floor() {
  cat <<SCENE
Film "rgb" "integer xresolution" $1 "integer yresolution" $2
Sampler "independent" "integer pixelsamples" $3
Integrator "volpath" "integer maxdepth" 3
LookAt 0 1 -4  0 0.5 0  0 1 0
Camera "perspective" "float fov" 45
WorldBegin
LightSource "point" "point3 from" [1 3 -1] "rgb I" [9 9 9]
Material "diffuse" "rgb reflectance" [0.5 0.4 0.3]
Shape "trianglemesh" "point3 P" [-4 0 -4 4 0 -4 4 0 4 -4 0 4] "integer indices" [0 1 2 0 2 3]
SCENE
}

# ball_of PARAMETERS: a ball of the medium that they say, above the floor.
ball_of() {
  cat <<SCENE
AttributeBegin
  MakeNamedMedium "m" $1 "rgb sigma_s" [1 1 1] "rgb sigma_a" [0.2 0.2 0.2]
  Material "interface"
  MediumInterface "m" ""
  Translate 0 0.6 0
  Shape "sphere" "float radius" 0.5
AttributeEnd
SCENE
}

# A quick scene with a surface, a medium and a light.
small_scene() { lit_floor 40 24 4; ball_of '"string type" "homogeneous"'; }
