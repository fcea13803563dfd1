# `tyndall regress` with a tiny suite: verdicts, isolation of crashes and hangs, blessing, files.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf suite report scratch
mkdir suite
small_scene >suite/fog.pbrt
small_scene >suite/lamp.pbrt
echo '{"spp": 16, "aovs": ["Albedo", "Z"], "bytes": true}' >suite/fog.json
echo '{"spp": 16, "reference_runs": 8}' >suite/lamp.json

# Without references nothing can be judged; --update makes them and says so.
expect 7 "$T" regress suite
says 'make one with --update' out.txt
expect 0 "$T" regress suite --update
says 'first reference, 256 samples' out.txt
says '2 new' out.txt
for file in fog.exr fog.bytes.exr lamp.exr; do [ -s suite/$file ] || fail "$file was not made"; done
[ -e suite/lamp.bytes.exr ] && fail "bytes that nobody asked for"
[ "$(ls -A suite | grep -c part)" = 0 ] || fail "a temporary file is left: $(ls -A suite)"

# Renders of the same scene agree, with this seed and others, on one job and on several, from any folder.
expect 0 "$T" regress suite --jobs 1
expect 0 "$T" regress suite --seed 7 -o report --junit junit.xml
says '2 pass' out.txt
(cd suite && expect 0 "$T" regress . --filter fog && rm out.txt err.txt)
expect 0 "$T" regress suite --filter 'l*' --json
says '"name": "lamp"' out.txt
grep -q fog out.txt && fail "--filter lets another case through"
[ "$(head -c 1 out.txt)" = "{" ] || fail "stdout does not start with JSON"
expect 2 "$T" regress suite --filter nothing
says 'fog, lamp' err.txt

# Renders side by side share the memory that there is.
expect 7 "$T" regress suite --filter lamp --max-memory 0.002 --jobs 2
says 'more than the limit of 0.001;' out.txt

# The report.
for text in '"what": "Albedo"' '"what": "Z"' '"what": "bytes"' '"what": "health"' '"seed": 7' '"passed": 2'; do says "$text" report/results.json; done
[ -s report/index.html ] || fail "no report/index.html"
for case in fog lamp; do expect 0 "$T" info report/renders/$case.exr; done
says 'tests="2" failures="0" errors="0"' junit.xml
if command -v python3 >/dev/null; then
  python3 -c 'import sys, xml.etree.ElementTree as e; sys.exit(len(e.parse("junit.xml").findall(".//testcase")) != 2)' || fail "junit.xml is not sound"
  python3 -c 'import json; json.load(open("report/results.json"))' || fail "results.json is not sound"
fi

# A light 3 % brighter, and a surface 3 % darker, are found; --update says what changed, and makes it right.
sed -i 's/\[9 9 9\]/[9.27 9.27 9.27]/' suite/lamp.pbrt
expect 5 "$T" regress suite --junit junit.xml
says '1 pass, 1 fail' out.txt
says '<failure type="fail"' junit.xml
expect 0 "$T" regress suite --update --filter lamp
grep -qE 'updated .*mean [0-9.]+ -> [0-9.]+ \(\+[23]\.[0-9]+ %\), differs in RGB' out.txt || fail "--update does not say what changed: $(cat out.txt)"
expect 0 "$T" regress suite
expect 0 "$T" regress suite --update --filter lamp
says 'no difference seen' out.txt

# A picture that is the same but for its bytes differs; so does a reference of another scene.
cp suite/fog.bytes.exr kept.exr
"$T" render suite/fog.pbrt --spp 16 --seed 5 --quiet -o suite/fog.bytes.exr
expect 5 "$T" regress suite --filter fog
says 'byte for byte' out.txt
cp kept.exr suite/fog.bytes.exr
expect 0 "$T" regress suite --filter fog
cp suite/fog.exr kept.exr
sed 's/0.5 0.4 0.3/0.5 0.4 0.31/' suite/fog.pbrt >suite/other.pbrt
cp suite/fog.json suite/other.json
"$T" regress suite --update --filter other >out.txt 2>err.txt
mv suite/other.exr suite/fog.exr
rm suite/other.*
expect 5 "$T" regress suite --filter fog
says 'differs in' out.txt
says 'Albedo' out.txt
cp kept.exr suite/fog.exr

# A broken scene, a hang and a crash each cost their own case and no other.
sed 's/WorldBegin/WorldBegun/' suite/fog.pbrt >suite/broken.pbrt
small_scene | sed 's/resolution" 40/resolution" 400/' >suite/hang.pbrt
echo '{"spp": 100000, "timeout": 0.5}' >suite/hang.json
small_scene >suite/crash.pbrt
expect 7 "$T" regress suite
grep -qE '^broken +error .*WorldBegun' out.txt || fail "the broken scene is not named: $(cat out.txt)"
grep -qE '^hang +timeout .*0.5 s' out.txt || fail "the hang is not named: $(cat out.txt)"
says '2 pass' out.txt
rm suite/broken.pbrt suite/hang.*
echo '{"spp": 1000000, "timeout": 6}' >suite/crash.json  # what the other renders of the case get
# renders_of PID: the processes of the renders that it runs.
renders_of() { for child in $(cat /proc/$1/task/$1/children); do grep -qzx render /proc/$child/cmdline && echo $child; done; }
"$T" regress suite --filter 'crash' --junit junit.xml >out.txt 2>err.txt &
parent=$!
soon eval 'kill -KILL $(renders_of $parent | head -n 1)'
wait $parent
[ $? = 7 ] || fail "a crash does not give exit code 7"
grep -qE '^crash +crash .*Killed' out.txt || fail "the crash is not named: $(cat out.txt)"
says '<error type="crash"' junit.xml
echo '{"spp": 1000000, "timeout": 600}' >suite/crash.json

# Ctrl-C ends it soon, leaves no process and no scratch folder behind.
mkdir -p scratch
interrupted INT '[ "$(renders_of $pid)" ]' env TMPDIR=$PWD/scratch "$T" regress suite --filter crash
[ $code = 130 ] || fail "an interrupted suite does not exit with 130"
[ -z "$(ls -A scratch)" ] || fail "a scratch folder is left: $(ls -A scratch)"

# Killed, it takes its renders with it; a zombie, which nobody may have fetched, is gone too.
interrupted KILL 'children=$(renders_of $pid); [ "$(echo $children | wc -w)" = 2 ]' \
  env TMPDIR=$PWD/scratch "$T" regress suite --filter crash --jobs 2
gone() { ! grep -q '^State:[[:space:]]*[^ZX[:space:]]' /proc/$1/status; }
for child in $children; do soon gone $child; done
# So does a table that cannot be printed, with its own exit code.
TMPDIR=$PWD/scratch "$T" regress suite --filter crash >/dev/full 2>err.txt
[ $? = 4 ] || fail "a table that cannot be printed does not exit with 4"
says 'stdout could not be written' err.txt
rm -r suite/crash.* scratch/*

# Numbers out of their range.
for level in nan 0 0.9 inf; do expect 2 "$T" regress suite --level $level; done
says 'must be a number from 1e-12 to 0.5' err.txt
expect 2 "$T" regress suite --seed 2e13
says '--seed: must be a whole number from 0 to' err.txt

# What is no suite, and settings that mean nothing.
expect 3 "$T" regress no_such_folder
expect 3 "$T" regress scratch
echo '{"ssp": 16}' >suite/lamp.json
echo '{}' >suite/orphan.json
cp suite/lamp.exr suite/lost.exr
expect 7 "$T" regress suite --junit junit.xml
says 'lamp.json: "ssp"' out.txt
says 'orphan.json: has no scene beside it' out.txt
says 'lost.exr: has no scene beside it' out.txt
says '1 pass, 3 error' out.txt
says 'errors="3"' junit.xml
expect 7 "$T" regress suite --filter orphan
expect 0 "$T" regress suite --filter fog
rm suite/orphan.json suite/lost.exr
echo '{"spp": 32}' >suite/lamp.json
expect 7 "$T" regress suite --filter lamp
says 'another "spp"' out.txt
# What the reference lacks cannot be judged.
mv suite/fog.bytes.exr kept.exr
expect 7 "$T" regress suite --filter fog
says 'fog.bytes.exr: is missing; make it with --update --filter fog' out.txt
mv kept.exr suite/fog.bytes.exr
sed 's/"Z"/"Z", "N"/' suite/fog.json >more.json
cp suite/fog.json kept.json
cp more.json suite/fog.json
expect 7 "$T" regress suite --filter fog
says 'fog.exr: lacks N' out.txt
cp kept.json suite/fog.json

cp suite/fog.exr kept.exr
expect 4 "$T" regress suite --filter fog --junit no/such/folder/junit.xml
grep -q '^fog' out.txt && fail "rendered before it was seen that --junit cannot be written"
says 'no/such/folder' err.txt
expect 4 "$T" regress suite --filter fog -o /dev/null/report
cmp suite/fog.exr kept.exr || fail "a failed run changed a reference"
finish
