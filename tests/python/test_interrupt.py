"""Ctrl-C: KeyboardInterrupt, soon, and an interpreter that goes on."""

import os
import signal
import subprocess
import sys
import time

import pytest

RENDER = """
import sys, time, tyndall
scene = tyndall.loads(sys.argv[1])
scene.resolution = 640, 384
print("rendering", flush=True)
try:
    {what}
except KeyboardInterrupt:
    scene.resolution = 8, 8
    print("interrupted", scene.render(spp=1).shape, time.process_time(), flush=True)
"""


def used_by(process):
    """Seconds of processor time, which a busy machine makes no longer."""
    with open(f"/proc/{process.pid}/stat") as stat:
        user, system = stat.read().rsplit(")", 1)[1].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def start(script, floor_text):
    """A program in the midst of its render: a second of processor time after it has said so goes into nothing else."""
    process = subprocess.Popen([sys.executable, "-c", script, floor_text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "rendering\n"
    begun = used_by(process)
    while used_by(process) < begun + 1:
        time.sleep(0.02)
    return process


@pytest.mark.parametrize("what", ["scene.render(spp=1 << 24)", "scene.compare({'a': {}}, time=1000, reference_error=1e-12)"])
def test_it_ends_soon_and_the_interpreter_goes_on(floor_text, what):
    process = start(RENDER.format(what=what), floor_text)
    limit = used_by(process) + 6 * os.cpu_count()
    process.send_signal(signal.SIGINT)
    rest, told = process.communicate(timeout=300)
    assert process.returncode == 0, told
    said, used = rest.rsplit(" ", 1)
    assert said == "interrupted (8, 8)" and float(used) < limit


def test_uncaught_it_ends_the_program(floor_text):
    script = RENDER.format(what="scene.render(spp=1 << 24)").replace("except KeyboardInterrupt", "except ZeroDivisionError")
    process = start(script, floor_text)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=300)
    assert "KeyboardInterrupt" in told and process.returncode == -signal.SIGINT


DAEMON = """
import sys, threading, time, tyndall
scene = tyndall.loads(sys.argv[1])
scene.resolution = 640, 384
begun = threading.Event()
def work():
    while True:
        {what}
threading.Thread(target=work, daemon=True).start()
{wait}
print("ending", flush=True)
"""
RENDERS = "scene.render(spp=1 << 24, progress=lambda p: begun.set())"


@pytest.mark.parametrize("what, wait", [
    (RENDERS, "begun.wait()"),
    (RENDERS, "time.sleep(0.1)"),
    ("begun.set(); scene.build()", "begun.wait()"),
    ("scene.compare({'a': {}}, time=1000, reference_error=1e-12)", "time.sleep(0.3)"),
])
def test_the_interpreter_ends_quietly_while_a_daemon_thread_renders(floor_text, what, wait):
    script = DAEMON.format(what=what, wait=wait)
    done = subprocess.run([sys.executable, "-c", script, floor_text], capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ending\n", "")
