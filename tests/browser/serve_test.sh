# The page of a render that goes on, in a headless Chromium; serve_page.py looks.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"

rm -rf profile ./*.pfm ./*.png
small_scene >scene.pbrt
timeout 500 python3 -B "$TYNDALL_SOURCE_DIR/tests/browser/serve_page.py" || fail "serve_page.py ended with code $?"
finish
