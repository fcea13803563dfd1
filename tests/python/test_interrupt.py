"""Ctrl-C: KeyboardInterrupt, soon, and an interpreter that goes on."""

import signal
import subprocess
import sys
import time

import pytest

RENDER = """
import sys, tyndall
scene = tyndall.loads(sys.argv[1])
scene.resolution = 640, 384
print("rendering", flush=True)
try:
    {what}
except KeyboardInterrupt:
    scene.resolution = 8, 8
    print("interrupted", scene.render(spp=1).shape, flush=True)
"""


@pytest.mark.parametrize("what", ["scene.render(spp=1 << 24)", "scene.compare({'a': {}}, time=1000, reference_error=1e-12)"])
def test_it_ends_soon_and_the_interpreter_goes_on(floor_text, what):
    process = subprocess.Popen([sys.executable, "-c", RENDER.format(what=what), floor_text], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "rendering\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    rest, _ = process.communicate(timeout=60)
    assert rest == "interrupted (8, 8)\n" and process.returncode == 0
    assert time.monotonic() - began < 6


def test_uncaught_it_ends_the_program(floor_text):
    script = RENDER.format(what="scene.render(spp=1 << 24)").replace("except KeyboardInterrupt", "except ZeroDivisionError")
    process = subprocess.Popen([sys.executable, "-c", script, floor_text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "rendering\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=60)
    assert "KeyboardInterrupt" in told and process.returncode == -signal.SIGINT
