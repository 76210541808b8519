#!/bin/sh
# The course page in a real browser: browser_test.sh BOOKSPIN FOLDER
# Makes a small site in FOLDER and runs browser_test.mjs and firefox_test.mjs. Exit code 77 when what browser_tools.sh fetches is not there.
set -u
bookspin=$1
folder=$2
here=$(cd "$(dirname "$0")" && pwd)
project=$(cd "$here/../.." && pwd)
mkdir -p "$folder" && cd "$folder" || exit 1
if ! command -v node >/dev/null || ! command -v chromium >/dev/null || [ ! -d node_modules/playwright-core ] ||
  [ ! -d node_modules/axe-core ]; then
  cat skipped 2>/dev/null || echo "page_browser skipped: make test fetches what it needs (tests/page/browser_tools.sh)"
  exit 77
fi

# Short films: their expectations are those of the long ones, so not all can be met. What matters is that all are made.
rm -rf site
"$bookspin" render "$project"/videos/*.toml -o site --size 192x108 --set clip.frames=75 >render.log
"$bookspin" render "$project/videos/fig01_axes.toml" -o site --size 192x108 >>render.log || exit 1
"$bookspin" render "$project/videos/fig08_neither.toml" -o site --size 192x108 --set clip.frames=75 --set clip.time_per_frame=0.2 >>render.log
rm -f site/fig01_axes.mp4
"$bookspin" report --quick -o site/report >report.log || exit 1
"$bookspin" page site || exit 1
for name in "my film" "50% #2?"; do
  cp "$project/videos/fig09_matrix.toml" "$name.toml"
  "$bookspin" render "$name.toml" -o site/own --size 192x108 --set clip.frames=75 >>render.log
done
"$bookspin" page site/own || exit 1
node "$here/browser_test.mjs" "$folder" "$project/videos" || exit 1
if command -v firefox-esr >/dev/null; then
  node "$here/firefox_test.mjs" "$folder" || exit 1
else
  echo "Firefox skipped: make test fetches it (tests/page/browser_tools.sh)"
fi
