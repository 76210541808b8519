#!/usr/bin/python3
"""What a course system's HTML cleaner leaves of a snippet: cleaner_test.py BOOKSPIN FOLDER. Exit code 77 without python3-bleach."""
import html
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import bleach
except ImportError:
    print("page_cleaner skipped: make test fetches python3-bleach (tests/page/browser_tools.sh)")
    sys.exit(77)

bookspin, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)  # what another build left is not to be met
videos = pathlib.Path(__file__).parents[2] / "videos"
for name, settings in (("fig09_matrix", ["--set", "clip.frames=60"]), ("fig01_axes", [])):
    subprocess.run([bookspin, "render", videos / f"{name}.toml", "-o", folder, "--size", "64x36", *settings], stdout=subprocess.DEVNULL)
subprocess.run([bookspin, "page", folder], check=True, stdout=subprocess.DEVNULL)
page = (folder / "index.html").read_text(encoding="utf-8")
snippet = {name: html.unescape(re.search(rf'<pre id="{name}-snippet"[^>]*>(.*?)</pre>', page, re.DOTALL)[1])
           for name in ("fig09_matrix", "fig01_axes")}

# Of a course system that knows films: no style, no figure, no aria, no data: addresses.
knows_films = {
    "tags": ["a", "div", "img", "p", "source", "track", "video"],
    "attributes": {"a": ["href"], "img": ["alt", "height", "src", "width"], "track": ["kind", "label", "src", "srclang"],
                   "video": ["controls", "height", "muted", "poster", "src", "title", "width"]},
}
failed = 0


def expect(what, text, *parts):
    global failed
    missing = [part for part in parts if part not in text]
    print(f"{'ok     ' if not missing else 'FAILED '} {what}" + "".join(f"\n        is gone: {part}" for part in missing))
    failed += bool(missing)


clean = bleach.clean(snippet["fig09_matrix"], **knows_films, strip=True)
caption = re.search(r"<p>([^<]{40,})", snippet["fig09_matrix"])[1].strip()
expect("a film that a course system has cleaned", clean, 'src="fig09_matrix.mp4"', 'poster="fig09_matrix.png"', "controls",
       'src="fig09_matrix.vtt"', '<a href="fig09_matrix.vtt">captions</a>', caption, 'title="')
expect("its captions are a file", (folder / "fig09_matrix.vtt").read_text(), "WEBVTT", "-->")
expect("a picture", bleach.clean(snippet["fig01_axes"], **knows_films, strip=True), 'src="fig01_axes.png"', 'width="64"', "alt=")
expect("what the strictest leaves of a film", bleach.clean(snippet["fig09_matrix"], strip=True),
       '<a href="fig09_matrix.mp4">Film</a>', '<a href="fig09_matrix.vtt">captions</a>')
sys.exit(failed > 0)
