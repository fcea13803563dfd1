"""The page of render --serve in a headless Chromium: what it shows, how it is worked, and what other pages cannot do to it."""

import array
import os
import re
import subprocess
import sys

from devtools import Browser

PROGRAM = os.environ["TYNDALL_BIN"]
failures = 0


def check(what, holds, seen=""):
    global failures
    if not holds:
        failures += 1
        print(f"FAILED: {what}; seen: {seen}")


class Render:
    """In a process of its own; `url` is where it can be seen."""

    def __init__(self, *options):
        self.process = subprocess.Popen([PROGRAM, "render", "scene.pbrt", "--progress", "none", *options, "--serve"],
                                        stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if found := re.search(r"http://127\.0\.0\.1:\d+/", line):
                self.url = found[0]
                return
        raise SystemExit("FAILED: no address was told")

    def end(self):
        said = self.process.stderr.read()
        return self.process.wait(), said


def pixels_of_pfm(path):
    """Rows from the top, [R, G, B] each."""
    with open(path, "rb") as file:
        head = [file.readline() for _ in range(3)]
        width, height = map(int, head[1].split())
        values = array.array("f", file.read())
    assert head[0] == b"PF\n" and float(head[2]) < 0 and len(values) == 3 * width * height
    return lambda x, y: values[3 * ((height - 1 - y) * width + x):][:3]


# What is on the canvas, as a number that another picture, place or exposure changes.
PRINT = """(() => { const c = document.querySelector('.window'), copy = document.createElement('canvas');
  Object.assign(copy, {width: c.width, height: c.height});
  const context = copy.getContext('2d', {willReadFrequently: true}); context.drawImage(c, 0, 0);
  return context.getImageData(0, 0, copy.width, copy.height).data.reduce((s, v, i) => (s * 31 + v * (i % 7 + 1)) % 1e9, 7); })()"""
SETTLE = "live.viewer.ready.then(() => new Promise((done) => setTimeout(done, 100)))"
TABS = "[...document.querySelectorAll('.tabs button')].map((b) => b.dataset.picture)"


def shown(page):
    page.run(SETTLE)
    return page.run(PRINT)


def click(page, selector):
    page.run(f"document.querySelector({selector!r}).click()")


def hidden(page, selector):
    return page.run(f"document.querySelector({selector!r}).getClientRects().length === 0")


def check_viewer(page):
    """A viewer that stands still: it is asked for nothing new meanwhile."""
    page.ask("Page.bringToFront")  # nothing is drawn in a page behind others
    tabs = page.run(TABS)
    check("pictures", tabs[:3] == ["rendered", "denoised", "error estimate"] and sorted(tabs[3:]) == ["Mse", "Z"], tabs)
    prints = {}
    for name in tabs:
        click(page, f".tabs button[data-picture='{name}']")
        prints[name] = shown(page)
        check(f"{name} is shown", page.run("document.querySelector('.viewer').dataset.picture") == name)
        check(f"the scale of errors beside {name}", hidden(page, ".error-legend") == (name != "error estimate"))
    check("every picture is another one", len({p for name, p in prints.items() if name != "Mse"}) == 4, prints)
    error = page.run("live.viewer.pictures.find((p) => p.kind === 'error').color(20, 12)[0]")
    check("an error in the picture's noise", 0 < error < 0.1, error)
    click(page, ".tabs button[data-picture='rendered']")
    plain = shown(page)
    page.run("live.viewer.set({stops: 2})")
    check("exposure", shown(page) != plain)
    page.run("live.viewer.set({stops: 0})")
    click(page, "button[aria-label='Zoom in']")
    check("zoom", shown(page) != plain)
    click(page, "button[aria-label='Fit into the window']")
    check("and back", shown(page) == plain)
    page.run("live.viewer.set({pixel: {x: 20, y: 12}})")
    said = page.run("document.querySelector('.readout').textContent")
    check("the values of a pixel", re.search(r"x 20, y 12\s*rendered  [\d.e-]+  [\d.e-]+  [\d.e-]+$", said), said)


def check_refused_cancel(page, render):
    """As of a page that an earlier program served: the program has another token."""
    click(page, ".cancel")
    page.run("RESULTS.kept = RESULTS.token, RESULTS.token = 'of another program'")
    click(page, ".stop")
    page.wait_for("!document.querySelector('.cancel-buttons [role=alert]').hidden")
    check("it says that it was refused", "load the page again" in page.run("document.querySelector('.cancel-buttons').textContent"))
    check("and can be asked again", not hidden(page, ".cancel") and hidden(page, ".stop") and render.process.poll() is None)
    page.run("RESULTS.token = RESULTS.kept")


def check_cancel(page, render):
    check("no question yet", hidden(page, ".stop") and hidden(page, ".keep") and not hidden(page, ".cancel"))
    click(page, ".cancel")
    check("it asks", not hidden(page, ".stop") and not hidden(page, ".keep") and hidden(page, ".cancel"))
    click(page, ".keep")
    check("it goes on", hidden(page, ".stop") and not hidden(page, ".cancel") and render.process.poll() is None)
    click(page, ".cancel")
    click(page, ".stop")
    code, said = render.end()
    check("exit code of an interrupt", code == 130, f"{code} {said}")
    page.wait_for("live.root.dataset.stage === 'ended'")
    status = page.run("live.status.textContent")
    check("the page says how it ended", re.fullmatch(r"stopped with \d+ samples a pixel, written to out\.pfm", status), status)
    check("nothing is left to cancel", hidden(page, ".cancel") and hidden(page, ".stop"))


def check_last_picture(page):
    """It is the one that was written, as halves."""
    file = pixels_of_pfm("out.pfm")
    for x, y in [(0, 0), (20, 12), (39, 23)]:
        seen = page.run(f"live.viewer.pictures.find((p) => p.name === 'denoised').color({x}, {y})")
        wanted = file(x, y)
        check("the last picture", all(abs(s - w) <= 1e-3 * abs(w) + 1e-7 for s, w in zip(seen, wanted)), f"{seen} {list(wanted)}")


def check_others(browser, render):
    """Pages of other places: one on the web, and one whose name was made to resolve here."""
    page = browser.open("about:blank")
    for method in ("POST", "GET"):
        page.run(f"fetch('{render.url}cancel', {{method: '{method}', mode: 'no-cors'}}).catch(() => 0)")
    read = page.run(f"fetch('{render.url}state').then(() => 'read', () => 'not read')")
    check("another page reads nothing", read == "not read", read)
    rebound = browser.open(render.url.replace("127.0.0.1", "evil.example"))
    rebound.wait_for("document.readyState === 'complete' && document.body.textContent.length > 0")
    check("a name that resolves here is refused", "this host is not served" in rebound.run("document.body.textContent"),
          rebound.run("document.body.textContent"))
    check("and the render goes on", render.process.poll() is None)


def check_cancelled(browser):
    render = Render("--denoise", "--aov", "Z", "--time", "500", "-o", "out.pfm")
    page = browser.open(render.url)
    page.wait_for("live.version > 0 && live.viewer.pictures.some((p) => p.name === 'denoised')")
    first = page.run("live.version")
    page.wait_for(f"live.version > {first}")  # it goes on by itself
    status = page.run("live.status.textContent")
    check("how far it is", re.fullmatch(r"rendering, \d+ samples a pixel, [\d:]+ done, [\d:]+ left, then denoising", status), status)
    error = page.run("live.error.textContent")
    check("the error", re.fullmatch(r"estimated relMSE of the picture shown: [\d.e-]+", error), error)
    check("the page spoke", browser.spoken == [], browser.spoken)
    page.screenshot("rendering.png")
    check("a picture of the page", os.path.getsize("rendering.png") > 20000)
    check_others(browser, render)
    check_refused_cancel(page, render)
    check_cancel(page, render)
    check_last_picture(page)
    check_viewer(page)


def check_complete(browser):
    """A page that looks until the end has the last picture when the program is gone. Pixels go by their place in the frame."""
    render = Render("--spp", "4096", "--crop", "6,40,5,24", "-o", "whole.pfm")
    page = browser.open(render.url)
    page.wait_for("live.version > 0")
    code, said = render.end()
    check("exit code", code == 0, f"{code} {said}")
    page.wait_for("live.root.dataset.stage === 'ended'")
    status = page.run("live.status.textContent")
    check("it is complete", status == "complete with 4096 samples a pixel, written to whole.pfm", status)
    page.run("live.viewer.set({pixel: {x: 20, y: 12}})")
    said = page.run("document.querySelector('.readout').textContent")
    check("the place of a pixel of a crop", said.startswith("x 26, y 17"), said)
    file, seen = pixels_of_pfm("whole.pfm")(20, 12), page.run("live.viewer.pictures[0].color(20, 12)")
    check("the last picture", all(abs(s - w) <= 1e-3 * w for s, w in zip(seen, file)), f"{seen} {list(file)}")


def check_lost(browser):
    """The program is killed: the page says so, and keeps its picture."""
    render = Render("--time", "500", "-o", "lost.pfm")
    page = browser.open(render.url)
    page.wait_for("live.version > 0")
    render.process.kill()
    page.wait_for("live.root.dataset.stage === 'lost'")
    check("it says so", "does not answer any more" in page.run("live.status.textContent"))
    check("the picture is there", page.run("live.viewer.pictures[0].halves !== null") and hidden(page, ".cancel"))


def main():
    browser = Browser(os.path.abspath("profile"), "MAP evil.example 127.0.0.1, MAP * ~NOTFOUND, EXCLUDE 127.0.0.1")
    for part in (check_cancelled, check_complete, check_lost):
        part(browser)
    browser.close()
    print(f"{failures} failures" if failures else "ok")
    return 1 if failures else 0


sys.exit(main())
