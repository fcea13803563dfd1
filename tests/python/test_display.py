"""render --display against viewers made here: one that looks, one that goes, one that sleeps, none. What is rendered is the same."""

import os
import socket
import struct
import subprocess
import threading
import time

import numpy as np
import pytest

import tyndall


class Viewer:
    """Listens, and keeps the images that it is sent as arrays by name; ``leave_after`` messages it hangs up."""

    def __init__(self, leave_after=None):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self.listener.getsockname()[1]
        self.images, self.updates, self.left = {}, 0, leave_after
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        connection, _ = self.listener.accept()
        stream = connection.makefile("rb")
        while head := stream.read(4):
            self.take(stream.read(struct.unpack("<I", head)[0] - 4))
            if self.left is not None and self.updates >= self.left:
                stream.close()
                connection.close()
                self.listener.close()
                return

    def take(self, message):
        kind, _focus = message[0], message[1]
        name, rest = message[2:].split(b"\0", 1)
        if kind == 4:
            width, height, count = struct.unpack_from("<3i", rest)
            names = rest[12:].split(b"\0")[:count]
            self.images[name.decode()] = {n.decode(): np.zeros((height, width), np.float32) for n in names}
        elif kind == 6:
            self.update(self.images[name.decode()], rest)
        else:
            raise ValueError(kind)

    def update(self, image, rest):
        (count,) = struct.unpack_from("<i", rest)
        rest = rest[4:]
        names = []
        for _ in range(count):
            name, rest = rest.split(b"\0", 1)
            names.append(name.decode())
        x, y, width, height = struct.unpack_from("<4i", rest)
        offsets = struct.unpack_from(f"<{count}q", rest, 16)
        strides = struct.unpack_from(f"<{count}q", rest, 16 + 8 * count)
        values = np.frombuffer(rest, "<f4", offset=16 + 16 * count)
        for name, offset, stride in zip(names, offsets, strides):
            tile = values[offset:offset + (width * height - 1) * stride + 1:stride]
            image[name][y:y + height, x:x + width] = tile.reshape(height, width)
        self.updates += 1


@pytest.fixture
def render(tmp_path, floor_text):
    """Renders the floor with 300 x 150 pixels, which are six tiles; gives the image, what was said, and the seconds."""
    (tmp_path / "floor.pbrt").write_text(floor_text)

    def run(*options, name="a.exr"):
        began = time.monotonic()
        done = subprocess.run([os.environ["TYNDALL_BIN"], "render", "floor.pbrt", "--resolution", "300x150", "--spp", "16", "--aov", "Z",
                               "--reproducible", "--quiet", "-o", name, *options], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return (tmp_path / name).read_bytes(), done.stderr, time.monotonic() - began

    return run


def test_a_viewer_sees_the_picture(render, tmp_path):
    viewer = Viewer()
    shown, said, _ = render("--display", viewer.address)
    viewer.thread.join(10)
    plain, _, _ = render(name="b.exr")
    assert shown == plain and said == ""
    file, seen = tyndall.read_image(tmp_path / "a.exr"), viewer.images["a.exr"]
    assert sorted(seen) == sorted(file) and "Z" in seen
    assert all(np.array_equal(seen[name], file[name]) for name in file)
    assert viewer.updates >= 6


def test_a_viewer_that_hangs_up_in_the_middle(render):
    viewer = Viewer(leave_after=2)
    shown, said, _ = render("--display", viewer.address)
    assert viewer.updates == 2
    assert shown == render(name="b.exr")[0]
    assert said.count("warning: --display") == 1 and "the render goes on" in said


def test_a_viewer_that_sleeps(render):
    with socket.create_server(("127.0.0.1", 0)) as asleep:  # takes the connection and what the system buffers, no more
        asleep.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        plain, _, usual = render(name="b.exr")
        shown, said, took = render("--display", "127.0.0.1:%d" % asleep.getsockname()[1])
    assert shown == plain and took < usual + 4
    assert "takes nothing any more" in said


def test_no_viewer(render):
    with socket.create_server(("127.0.0.1", 0)) as listener:
        address = "127.0.0.1:%d" % listener.getsockname()[1]
    shown, said, _ = render("--display", address)
    assert shown == render(name="b.exr")[0]
    assert said.count("warning: --display") == 1


@pytest.mark.parametrize("address, message", [("14158", "give HOST:PORT"), (":14158", "give HOST:PORT"), ("127.0.0.1:", "give HOST:PORT"),
                                              ("no.such.host.invalid:14158", "check host and port")])
def test_addresses_that_cannot_be(tmp_path, program, floor_text, address, message):
    (tmp_path / "floor.pbrt").write_text(floor_text)
    done = program("render", tmp_path / "floor.pbrt", "--display", address, "-o", tmp_path / "a.exr")
    assert done.returncode == 2 and message in done.stderr and not (tmp_path / "a.exr").exists()
