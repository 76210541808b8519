#!/bin/sh
# What the page's test in a browser needs beyond the rest, fetched into FOLDER: browser_tools.sh FOLDER
# Debian's node, Chromium, Firefox and a display for it, a cleaner of HTML, and two packages of npm. Says what it fetches. When something cannot be
# fetched the reason is printed and left in FOLDER/skipped, and that test is skipped; the exit code is 0 all the same.
set -u
project=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1" && cd "$1" || exit 1
rm -f skipped

skip() {
  echo "page_browser skipped: $1" | tee skipped
  exit 0
}

# need COMMAND PACKAGE...: the command is there, or the packages can be installed.
need() {
  command -v "$1" >/dev/null && return
  shift
  printf '%s\n' "$@" >packages.txt
  "$project/install-packages" "$PWD/packages.txt" || skip "$* could not be installed"
}

need npm nodejs npm
if [ ! -d node_modules/playwright-core ] || [ ! -d node_modules/axe-core ]; then
  npm ping --fetch-retries=0 --fetch-timeout=10000 >npm.log 2>&1 ||
    skip "npm reaches no registry: $(grep -m 1 -i error npm.log || echo no answer in ten seconds)"
  echo "Fetching playwright-core and axe-core by npm: 15 MB on disk"
  timeout 120 npm install --prefix "$PWD" --fetch-retries=1 --fetch-timeout=30000 --no-audit --no-fund --no-save \
    playwright-core@1.65.1 axe-core@4.14.1 >npm.log 2>&1 ||
    skip "npm could not fetch playwright-core and axe-core: $(grep -m 1 -i error npm.log || echo no answer in two minutes)"
fi
need chromium chromium
{ command -v firefox-esr && command -v Xvfb; } >/dev/null || { printf 'firefox-esr\nxvfb\n' >packages.txt && "$project/install-packages" "$PWD/packages.txt"; } ||
  echo "Firefox skipped: firefox-esr could not be installed" | tee skipped
/usr/bin/python3 -c 'import bleach' 2>/dev/null || { echo python3-bleach >packages.txt && "$project/install-packages" "$PWD/packages.txt"; } ||
  echo "page_cleaner skipped: python3-bleach could not be installed" | tee -a skipped
exit 0
