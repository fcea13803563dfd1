# The HTML reports in a headless Chromium. Beside each page stands a copy with a probe appended: a script that presses keys,
# turns wheels and clicks, and leaves what it finds in the document, which Chromium prints.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
here=$TYNDALL_SOURCE_DIR/tests/browser

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  { echo "FAILED: no Chromium; install the Debian package chromium (./tyndall test does)"; exit 1; }
rm -rf pages profile
mkdir pages
"$TYNDALL_WRITE_PAGES" pages || { echo "FAILED: the pages could not be written"; exit 1; }

# open_page URL OUT: the document after its scripts have run; what the console said is in err.txt.
open_page() {
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$PWD/profile" --no-first-run \
    --host-resolver-rules="MAP * ~NOTFOUND" --enable-logging=stderr --window-size=1400,1000 --virtual-time-budget=60000 \
    --dump-dom "file://$PWD/$1" >"$2" 2>err.txt || fail "Chromium ended with code $? on $1: $(tail -n 3 err.txt)"
}

# quiet PAGE: nothing was said on the console.
quiet() {
  if grep "CONSOLE" err.txt; then fail "the console of $1 speaks"; fi
}

for page in compare denoised regress; do
  # What is embedded is results.json, but for the escape of "<".
  sed -n 's/.*id="results">\(.*\)<\/script>$/\1/p' pages/$page.html | sed 's/\\u003c/</g' | tr -d '\n' | cmp - pages/$page.json ||
    fail "$page.html does not hold results.json"

  open_page pages/$page.html plain.html
  quiet "$page.html"

  # The probe goes before the last </body>; names in the data are escaped and hold none.
  probed=pages/${page}_probed.html
  { sed '$d' pages/$page.html | sed '$d'; echo "<script>"; cat "$here/probe.js" "$here/probe_$page.js"; echo "</script></body></html>"; } >"$probed"
  open_page "$probed" dom.html
  quiet "$page.html under the probe"
  grep -o '<li class="probe-[a-z]*">[^<]*' dom.html | sed 's/<li class="probe-//; s/">/: /' >findings.txt
  grep '^failed' findings.txt && fail "$page.html does not behave"
  says 'done: all' findings.txt
  printf '%s: %s checks\n' "$page" "$(grep -c '^passed' findings.txt)"
done

# Nothing on the pages asks for another file or a host.
if grep -nE '(src|href)="(https?:)?//|@import|url\(' pages/compare.html | cut -c 1-200 | grep .; then fail "an external resource"; fi

finish
