#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""check_pages.py WRITE_VIEW_SAMPLES FOLDER: looks at pages in a headless browser: pictures of chosen frames,
and what the page says. Exit code 77 (ctest: skipped) where there is no Chromium. GMSIM_BROWSER names one."""
import html
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

WIDTH, HEIGHT = 640, 480
VIEW = (140, 105, 410, 420)  # columns and rows of the picture that no panel covers: left, top, right, bottom
BACKGROUND = (0xEE, 0xF1, 0xF4)

# Done in the page once it is ready; the texts that it has then are read from the printed document.
ACT = """<script>
const wait = setInterval(() => {
  if (!document.body.dataset.ready) return;
  clearInterval(wait);
  const get = (id) => document.getElementById(id), canvas = document.querySelector('canvas');
  const click = (x, y) => ['pointerdown', 'pointerup'].forEach((type) => canvas.dispatchEvent(
    new PointerEvent(type, { clientX: x, clientY: y, pointerId: 1, bubbles: true })));
  const press = (key) => document.body.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
  const choose = (id, value) => {
    get(id).value = value;
    for (const type of ['input', 'change']) get(id).dispatchEvent(new Event(type, { bubbles: true }));
  };
  const seen = {};
  const note = (name) => { seen[name] =
    [get('label'), get('notice'), get('picked'), get('high'), get('meaning'), get('play')].map((e) => e.textContent); };
  ACTIONS
  get('notice').textContent = 'SEEN' + JSON.stringify(seen) + 'END';
}, 50);
</script>"""


def find_browser():
    names = [os.environ.get("GMSIM_BROWSER"), "chromium", "chromium-browser", "google-chrome", "chrome"]
    return next(filter(None, (shutil.which(name) for name in names if name)), None)


def browse(browser, url, *options):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [browser, "--headless", "--no-sandbox", "--enable-unsafe-swiftshader", "--hide-scrollbars",
             "--force-device-scale-factor=1", f"--user-data-dir={profile}", f"--window-size={WIDTH},{HEIGHT}",
             "--virtual-time-budget=3000", *options, url],
            check=True, capture_output=True, text=True, timeout=120).stdout


def read_png(path):
    """Rows of (r, g, b); PNG specification, 8 bits a channel, not interlaced."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    assert depth == 8 and colour in (2, 6), (depth, colour)
    channels = 3 if colour == 2 else 4
    raw, size = zlib.decompress(packed), channels * width
    rows, above = [], bytes(size)
    for y in range(height):
        kind, row = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for i in range(size):
            left = row[i - channels] if i >= channels else 0
            up, corner = above[i], above[i - channels] if i >= channels else 0
            if kind == 1:
                add = left
            elif kind == 2:
                add = up
            elif kind == 3:
                add = (left + up) // 2
            elif kind == 4:
                guess = left + up - corner
                add = min((left, up, corner), key=lambda value: abs(guess - value))
            else:
                break
            row[i] = (row[i] + add) & 255
        above = bytes(row)
        rows.append([tuple(row[i:i + 3]) for i in range(0, size, channels)])
    return rows


class Checks:
    def __init__(self, browser, folder):
        self.browser, self.folder, self.failures = browser, folder, []

    def expect(self, condition, what):
        if not condition:
            self.failures.append(what)

    def picture(self, page, hash_text):
        """The pixels of the part of a page that no panel covers."""
        path = self.folder / f"{page}_{re.sub('[^a-z0-9]+', '_', hash_text)}.png"
        browse(self.browser, f"{(self.folder / page).as_uri()}.html#{hash_text}", f"--screenshot={path}")
        left, top, right, bottom = VIEW
        return [pixel for row in read_png(path)[top:bottom] for pixel in row[left:right]]

    def texts(self, page, hash_text):
        """What elements of a page say, by id, and the text of the whole document."""
        document = browse(self.browser, f"{(self.folder / page).as_uri()}.html{hash_text}", "--dump-dom")
        document = document.split('<script type="application/json"')[0]
        found = re.findall(r'<div id="(\w+)">([^<]*)</div>', document)
        frame = re.search(r'data-frame="(\d+)"', document)
        return {name: html.unescape(text) for name, text in found}, int(frame[1]) if frame else None

    def acted(self, page, hash_text, actions):
        """What the page says after each `note(…)` among the actions."""
        source = (self.folder / f"{page}.html").read_text(encoding="utf-8")
        copy = self.folder / f"{page}_acted.html"
        copy.write_text(source.replace("</body>", ACT.replace("ACTIONS", actions) + "</body>"), encoding="utf-8")
        texts, _ = self.texts(f"{page}_acted", hash_text)
        seen = re.search("SEEN(.*)END", texts["notice"], re.S)
        return json.loads(seen[1]) if seen else {}


def drawn(pixels):
    return sum(pixel != BACKGROUND for pixel in pixels) / len(pixels)


def differing(one, other):
    return sum(a != b for a, b in zip(one, other)) / len(one)


def bluish(pixels):
    """The share of pixels in the colour of bodies that no field colours."""
    return sum(b > r + 25 and b > g > r for r, g, b in pixels) / len(pixels)


def check_pictures(checks):
    for page, least in (("sheet", 0.25), ("block", 0.25), ("chain", 0.003)):
        frames = {k: checks.picture(page, f"frame={k}") for k in (0, 60)}
        for k, pixels in frames.items():
            checks.expect(drawn(pixels) > least, f"{page}, frame {k}: {drawn(pixels):.2%} is drawn")
            checks.expect(bluish(pixels) > 0.7 * least, f"{page}, frame {k}: {bluish(pixels):.2%} is surface or line")
        checks.expect(differing(frames[0], frames[60]) > least / 4, f"{page}: frames 0 and 60 look alike")
    near = drawn(checks.picture("block", "frame=0&fit=frame"))
    checks.expect(near > 1.1 * drawn(checks.picture("block", "frame=0")), f"fitted to frame 0, {near:.2%} is drawn")
    sides = checks.picture("sheet", "frame=60&field=side&edges=off")
    yellow = sum(r > 150 and g > 130 and b < 100 for r, g, b in sides) / len(sides)
    purple = sum(r < 90 and g < 30 and 40 < b < 110 for r, g, b in sides) / len(sides)
    checks.expect(yellow > 0.08 and purple > 0.08, f"halves by cell: {yellow:.2%} yellow, {purple:.2%} purple")
    dark = [sum(sum(p) < 330 for p in checks.picture("sheet", f"frame=0&edges={edges}")) for edges in ("on", "off")]
    checks.expect(dark[0] > 1.5 * dark[1], f"edges on and off: {dark} dark pixels")


def check_texts(checks):
    texts, frame = checks.texts("sheet", "#frame=40&field=velocity")
    checks.expect(frame == 40, f"#frame=40 shows frame {frame}")
    checks.expect(texts.get("label") == "t = 2 s, frame 40 of 61 (step 2000)\n435 points, 384 cells, 10 tears",
                  f"label: {texts.get('label')!r}")
    checks.expect(re.fullmatch(r"[\d.]+ m/s", texts.get("high", "")), f"legend: {texts.get('high')!r}")
    checks.expect(texts.get("meaning") == "length, by point", f"legend: {texts.get('meaning')!r}")
    high = {spread: float(checks.texts("chain", f"#frame=2&field=velocity&range={spread}")[0]["high"].split()[0])
            for spread in ("run", "frame")}
    checks.expect(high["frame"] < 0.5 * high["run"], f"largest speed of the run and of a frame: {high}")
    checks.expect(checks.texts("sheet", "#frame=-1")[1] == 60, "#frame=-1 is not the last frame")
    checks.expect(checks.texts("sheet", "#frame=5000")[1] == 60, "#frame=5000 is not the last frame")
    # It goes round in about the time that the browser is given, so it may be at frame 0 again when looked at.
    checks.expect(any(checks.texts("chain", "")[1] != 0 for _ in range(5)), "a page without #frame does not play")
    playing = checks.acted("chain", "", "note('opened');")
    checks.expect(playing["opened"][-1] == "pause", "a page without #frame does not say that it plays")
    texts, _ = checks.texts("chain", "#frame=0&field=sid")
    checks.expect(texts.get("notice") == "there is no field sid", f"notice: {texts.get('notice')!r}")


def check_controls(checks):
    seen = checks.acted("block", "#frame=10", """
      note('first'); press('ArrowRight'); note('next'); press('ArrowLeft'); press('ArrowLeft'); note('before');
      click(canvas.clientWidth / 2, 0.45 * canvas.clientHeight); note('clicked'); choose('field', 1); note('coloured'); click(5, canvas.clientHeight / 2); note('beside');
      choose('slider', 60); note('last'); press(' '); note('playing'); press(' '); note('paused');
      document.querySelector('#edges').click(); press('h');""")
    label, notice, picked, high, meaning, play = range(6)
    for name, frame in (("first", 10), ("next", 11), ("before", 9), ("last", 60)):
        checks.expect(f"frame {frame} of 61" in seen[name][label], f"{name}: {seen[name][label]!r}")
    checks.expect(re.fullmatch(r"point \d+, cell \d+", seen["clicked"][picked]), f"click: {seen['clicked'][picked]!r}")
    found = re.fullmatch(r"point \d+, cell (\d+): side ≈ ([01])", seen["coloured"][picked])
    checks.expect(found and (int(found[1]) % 10 >= 5) == (found[2] == "1"), f"value: {seen['coloured'][picked]!r}")
    checks.expect(seen["coloured"][high] == "1", f"legend: {seen['coloured'][high]!r}")
    checks.expect(seen["beside"][picked] == "", f"click beside the body: {seen['beside'][picked]!r}")
    checks.expect([seen[name][play] for name in ("last", "playing", "paused")] == ["play", "pause", "play"],
                  "space does not play and pause")


def main():
    writer, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    browser = find_browser()
    if not browser:
        print("skipped: no Chromium in PATH (Debian: apt-get install chromium); or name one in GMSIM_BROWSER")
        return 77
    subprocess.run([writer, str(folder)], check=True)
    checks = Checks(browser, folder.resolve())
    for check in (check_texts, check_controls, check_pictures):
        check(checks)
    for failure in checks.failures:
        print("failed:", failure)
    if not checks.failures:
        print("pages looked at in", browser)
    return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
