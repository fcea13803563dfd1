"""render --serve as a server: what is rendered is the same whoever looks, and however badly; what cannot be is said."""

import json
import os
import re
import signal
import socket
import subprocess
import threading
import time
import urllib.error
import urllib.request

import pytest


def ask(url, data=None, **headers):
    """Status and body of an answer."""
    request = urllib.request.Request(url, data=data, headers={k.replace("_", "-"): v for k, v in headers.items()})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


class Render:
    def __init__(self, folder, *options):
        self.process = subprocess.Popen([os.environ["TYNDALL_BIN"], "render", "floor.pbrt", "--progress", "none", "--reproducible", *options],
                                        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = ""
        while line := self.process.stderr.readline():
            self.said += line
            if found := re.search(r"http://\S+/", line):
                self.url = found[0]
                self.address = ("127.0.0.1", int(self.url.rsplit(":", 1)[1][:-1]))
                break

    def state(self, viewer=""):
        return json.loads(ask(self.url + "state" + viewer)[1])

    def wait_for(self, stage):
        while self.state()["stage"] != stage:
            pass

    def cancel(self):
        token = re.search(r'"token":"(\w+)"', ask(self.url)[1].decode())[1]
        return ask(self.url + "cancel", b"", Origin=self.url[:-1], X_Tyndall_Token=token)

    def end(self):
        out, rest = self.process.communicate(timeout=300)
        return self.process.returncode, self.said + rest


@pytest.fixture
def render(tmp_path, floor_text):
    (tmp_path / "floor.pbrt").write_text(floor_text)
    started = []

    def run(*options, name="a.exr"):
        started.append(Render(tmp_path, "-o", name, *options))
        return started[-1]

    yield run
    for r in started:
        r.process.kill()
        r.process.wait()


def plain(render, tmp_path, *options):
    code, said = render(*options, name="plain.exr").end()
    assert code == 0, said
    return (tmp_path / "plain.exr").read_bytes()


OPTIONS = ("--resolution", "160x80", "--spp", "64", "--aov", "Z")


def test_who_looks_changes_no_bit(render, tmp_path):
    r = render(*OPTIONS, "--serve")
    seen = set()
    try:
        while True:
            state = r.state("/viewer/0")
            seen.add(state["stage"])
            for number in range(len(state["pictures"])):
                ask(f"{r.url}picture/{state['version']}/{number}")
            if state["stage"] == "ended":
                assert state["outcome"] == "complete with 64 samples a pixel, written to a.exr"
                ask(f"{r.url}state/viewer/{state['version']}")
    except OSError:
        pass  # it is gone
    code, said = r.end()
    assert code == 0, said
    assert {"rendering", "ended"} <= seen
    assert (tmp_path / "a.exr").read_bytes() == plain(render, tmp_path, *OPTIONS)


def test_bad_clients_cost_no_render(render, tmp_path):
    """Silent ones, some that trickle, some that ask for pictures and take none: as many as the system lets wait."""
    r = render(*OPTIONS, "--serve")
    ask(r.url + "state/viewer/0")
    clients = []
    for kind in range(40):
        client = socket.socket()
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        client.settimeout(1)
        try:
            client.connect(r.address)
            client.sendall([b"", b"GET / HT", b"GET /picture/1/0 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", b"\x00" * 20000][kind % 4])
        except OSError:
            pass  # it was hung up on
        clients.append(client)
    code, said = r.end()
    assert code == 0, said
    assert (tmp_path / "a.exr").read_bytes() == plain(render, tmp_path, *OPTIONS)


def test_cancel_is_an_interrupt(render, tmp_path):
    r = render("--time", "500", "--resume", "--serve")
    r.wait_for("rendering")
    assert ask(r.url + "cancel")[0] == 404
    assert ask(r.url + "cancel", b"", Origin=r.url[:-1])[0] == 403
    assert ask(r.url + "cancel", b"", Origin="http://evil.example", X_Tyndall_Token="0" * 32)[0] == 403
    assert ask(r.url + "state", Host="evil.example")[0] == 403
    assert r.process.poll() is None
    assert r.cancel()[0] == 200
    code, said = r.end()
    assert code == 130 and "stopping soon" in said, said
    assert (tmp_path / "a.exr").exists() and (tmp_path / "a.exr.checkpoint").exists()


def test_an_interrupt_and_a_cancel_together_lose_nothing(render, tmp_path):
    r = render("--time", "500", "--serve")
    r.wait_for("rendering")
    token = re.search(r'"token":"(\w+)"', ask(r.url)[1].decode())[1]
    r.process.send_signal(signal.SIGINT)
    try:
        ask(r.url + "cancel", b"", Origin=r.url[:-1], X_Tyndall_Token=token)
    except OSError:
        pass  # it has ended already
    code, said = r.end()
    assert code == 130, said
    assert (tmp_path / "a.exr").exists()


@pytest.mark.parametrize("options", [("--adaptive", "--error", "0.001"), ("--time", "2"), ("--denoise", "--spp", "64"),
                                     ("--denoise", "--spp", "64", "--preview-every", "1"), ("--slice", "1/2", "--spp", "64"),
                                     ("--spp", "64", "--resume"), ("--spp", "64", "--display", "127.0.0.1:1")])
def test_with_other_options(render, tmp_path, options):
    size = ("--resolution", "80x40")
    r = render(*size, *options, "--serve")
    looking = threading.Thread(target=look, args=(r,))
    looking.start()
    code, said = r.end()
    looking.join()
    assert code == 0, said
    if "--time" not in options and "--slice" not in options:  # a slice holds its command
        assert (tmp_path / "a.exr").read_bytes() == plain(render, tmp_path, *size, *options)


def look(r):
    try:
        while (state := r.state("/viewer/0"))["stage"] != "ended":
            assert all(ask(f"{r.url}picture/{state['version']}/{n}")[0] in (200, 404) for n in range(len(state["pictures"])))
            time.sleep(0.05)
    except OSError:
        pass


def test_one_page_for_a_sequence(render, tmp_path):
    r = render("--frames", "1-3", "--spp", "64", "--serve", name="f.%d.exr")
    outputs = []
    try:
        while (state := r.state("/viewer/0"))["stage"] != "ended":
            if state["output"] not in outputs:
                outputs.append(state["output"])
        assert state["outcome"] == "3 frames of 3 are there, as f.%d.exr"
    except OSError:
        pass
    code, said = r.end()
    assert code == 0, said
    assert said.count("http://") == 1
    frames = [o for o in outputs if o]
    assert frames == sorted(frames) and frames[-1] == "f.3.exr" and len(frames) <= 3  # short frames are missed


def test_a_sequence_tells_its_page_why_it_ended(render, tmp_path):
    (tmp_path / "f.2.exr").mkdir()
    r = render("--frames", "1-3", "--spp", "64", "--serve", name="f.%d.exr")
    state = None
    try:
        while (state := r.state("/viewer/0"))["stage"] != "ended":
            pass
    except OSError:
        pass
    code, said = r.end()
    assert code != 0
    assert state["outcome"].startswith("1 frames of 3 are there, as f.%d.exr; ") and state["outcome"].endswith(" (frame 2)")
    assert state["outcome"].split("; ", 1)[1] in said


def test_a_sequence_that_is_cancelled(render, tmp_path):
    r = render("--frames", "1-3", "--spp", "1000000", "--serve", name="f.%d.exr")
    r.wait_for("rendering")
    assert r.cancel()[0] == 200
    code, said = r.end()
    assert code == 130, said
    assert (tmp_path / "f.1.exr").exists() and not (tmp_path / "f.2.exr").exists()


def test_a_port_that_is_taken(render, tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        code, said = render("--serve", str(port)).end()
    assert code == 1 and said == (f"tyndall: --serve 127.0.0.1:{port} cannot be listened on (Address already in use); "
                                  "give another port, or none for one that is free\n")
    assert not (tmp_path / "a.exr").exists()


def test_a_port_that_was_asked_for(render):
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    r = render("--time", "500", "--serve", str(port))
    assert r.url == f"http://127.0.0.1:{port}/"
    assert ask(r.url)[0] == 200


def test_other_machines_only_when_told(render):
    r = render("--time", "500", "--serve", "0.0.0.0:0")
    assert "warning: --serve 0.0.0.0:0: whoever reaches this machine there can see the render and cancel it" in r.said
    assert ask(f"http://127.0.0.1:{r.address[1]}/state")[0] == 200
    assert "warning" not in render("--time", "500", "--serve").said


@pytest.mark.parametrize("options, message", [
    (("--serve", "floor.pbrt"), "--serve floor.pbrt is not understood"), (("--serve", "70000"), "--serve 70000 is not understood"),
    (("--serve", "no.such.host.invalid:80"), "check the host"), (("--quiet", "--serve"), "give a port")])
def test_what_cannot_be(render, tmp_path, options, message):
    code, said = render(*options).end()
    assert code == 2 and message in said and said.count("\n") == 1
    assert not (tmp_path / "a.exr").exists()
