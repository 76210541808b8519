#!/bin/sh
# The course page in a real browser: browser_test.sh BOOKSPIN FOLDER
# Makes a small site in FOLDER, fetches there what only this test needs (Debian's Chromium, and two packages of npm), and runs
# browser_test.mjs. Exit code 77, with the reason printed and left in FOLDER/skipped, when something cannot be fetched.
set -u
bookspin=$1
folder=$2
here=$(cd "$(dirname "$0")" && pwd)
project=$(cd "$here/../.." && pwd)
mkdir -p "$folder" && cd "$folder" || exit 1
rm -f skipped

skip() {
  echo "page_browser skipped: $1" | tee skipped
  exit 77
}

# need COMMAND PACKAGE: the command is there, or its package can be installed.
need() {
  command -v "$1" >/dev/null && return
  echo "$2" >wanted-package
  "$project/install-packages" "$folder/wanted-package" >install.log 2>&1 ||
    skip "there is no $1, and the package $2 could not be installed: $(tail -n 1 install.log)"
}
need chromium chromium
need node nodejs
need npm npm
if [ ! -d node_modules/playwright-core ] || [ ! -d node_modules/axe-core ]; then
  timeout 120 npm install --prefix "$folder" --fetch-retries=1 --fetch-timeout=30000 --no-audit --no-fund --no-save playwright-core@1.65.1 axe-core@4.14.1 >npm.log 2>&1 ||
    skip "npm could not fetch playwright-core and axe-core: $(grep -m 1 -i error npm.log || echo no answer in two minutes)"
fi

# Short films: their expectations are those of the long ones, so not all can be met. What matters is that all are made.
rm -rf site
"$bookspin" render "$project"/videos/*.toml -o site --size 192x108 --set clip.frames=75 >render.log
"$bookspin" render "$project/videos/fig01_axes.toml" -o site --size 192x108 >>render.log || exit 1
"$bookspin" render "$project/videos/fig08_neither.toml" -o site --size 192x108 --set clip.frames=75 --set clip.time_per_frame=0.2 >>render.log
rm -f site/fig01_axes.mp4
"$bookspin" page site || exit 1
node "$here/browser_test.mjs" "$folder" "$project/videos"
