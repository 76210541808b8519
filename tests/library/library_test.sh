#!/bin/sh
# library_test.sh PART FOLDER: the library as other projects find it, in FOLDER, after `library_test.sh install FOLDER`.
# Environment: CMAKE, CXX, CC (programs), BUILD (the build folder). Exit code 77 when a tool is not there.
set -eu
part=$1
folder=$2
prefix=$folder/prefix
project=$(cd "$(dirname "$0")/../.." && pwd)
here=$project/tests/library
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
times="0 137.5 275 412.5"  # of exact.toml

skip() { echo "library_$part skipped: $*"; exit 77; }

# Every form of the library gives the same bits.
same_as_the_library() { diff "$folder/found" "$1" && echo "the numbers of the library, to the last digit"; }

case $part in
install)
  rm -rf "$folder"
  "$CMAKE" --install "$BUILD" --prefix "$prefix" >"$BUILD/library_test.log"
  # From an empty folder, the installed program finds the files installed beside it, not those of the source tree.
  cp "$prefix/share/bookspin/videos/fig01_axes.toml" "$prefix/share/bookspin/videos/only_here.toml"
  mkdir "$folder/empty"
  cd "$folder/empty"
  "$prefix/bin/bookspin" list | grep only_here
  "$prefix/bin/bookspin" trajectory "$here/exact.toml" -o "$folder/exact.csv"
  awk -F, 'NR > 1 { print $28, $29, $30, $31 }' "$folder/exact.csv" >"$folder/expected"
  ;;
package)
  command -v dpkg-shlibdeps >/dev/null || skip "there is no dpkg-shlibdeps"
  command -v file >/dev/null || skip "there is no program file"
  (cd "$BUILD" && "${CMAKE%cmake}cpack" -B "$folder/package") >"$BUILD/package_test.log"
  dpkg-deb -I "$folder"/package/bookspin_*.deb | grep -E 'Depends: .*fonts-inter.*libosmesa6 [|] libegl1'
  dpkg-deb -x "$folder"/package/bookspin_*.deb "$folder/unpacked"
  # In a folder that has never seen the checkout; by its own files, which are looked for there first.
  usr=$folder/unpacked/usr
  mkdir -p "$folder/stranger"
  cd "$folder/stranger"
  cp "$usr/share/bookspin/videos/fig01_axes.toml" mine.toml
  "$usr/bin/bookspin" doctor | grep "have *own files *$usr/share/bookspin"
  "$usr/bin/bookspin" check mine.toml
  "$usr/bin/bookspin" render mine.toml --size 160x90 --set clip.frames=12
  "$usr/bin/bookspin" page
  test -s site/mine.mp4 && test -s site/index.html
  gzip -t "$usr/share/man/man1/bookspin.1.gz"
  for made in bash-completion/completions/bookspin zsh/vendor-completions/_bookspin bookspin/scene.schema.json; do
    test -s "$usr/share/$made"
  done
  ;;
cmake)
  "$CMAKE" -S "$project/examples/exact" -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$CXX"
  "$CMAKE" --build "$folder/cmake"
  "$folder/cmake/exact" $times >"$folder/found"
  # The table's q is normalized again, and has w >= 0. Measured: 2.3e-16 at most.
  paste -d " " "$folder/found" "$folder/expected" | awk '
    { d = 0; for (i = 1; i <= 4; ++i) d += $i * $(i + 4)
      for (i = 1; i <= 4; ++i) { e = $i * (d < 0 ? -1 : 1) - $(i + 4); if (e < 0) e = -e; if (e > worst) worst = e } }
    END { print "farthest from bookspin trajectory:", worst, "in", NR, "rows"; exit !(NR == 4 && worst < 1e-15) }'
  ;;
pkg_config)
  command -v pkg-config >/dev/null || skip "there is no pkg-config"
  pkg-config --exists eigen3 || skip "pkg-config does not know Eigen"
  "$CXX" -std=c++20 "$project/examples/exact/main.cpp" $(pkg-config --cflags --libs bookspin-dynamics) -o "$folder/pkg_config"
  "$folder/pkg_config" $times >"$folder/pkg_config.found"
  same_as_the_library "$folder/pkg_config.found"
  ;;
single_header)
  pkg-config --exists eigen3 || skip "pkg-config does not know Eigen"
  mkdir -p "$folder/alone"
  cp "$prefix/include/bookspin_dynamics.h" "$folder/alone"
  sed 's|<bookspin/dynamics/rigid_motion.h>|"bookspin_dynamics.h"|' "$project/examples/exact/main.cpp" >"$folder/alone/main.cpp"
  echo '#include "bookspin_dynamics.h"' >"$folder/alone/second.cpp"  # each definition may be there twice
  cd "$folder/alone"
  "$CXX" -std=c++20 -Wall -Wextra -Wpedantic -Werror -ffp-contract=off -DEIGEN_DONT_VECTORIZE $(pkg-config --cflags eigen3) main.cpp second.cpp -o exact
  ./exact $times >found
  same_as_the_library found
  ;;
c)
  "$CC" -std=c99 -Wall -Wextra -Wpedantic -Werror "$here/c_api_test.c" -I"$prefix/include/bookspin" -L"$prefix/lib" \
    -lbookspin_dynamics -lm -o "$folder/c_api_test"
  LD_LIBRARY_PATH=$prefix/lib "$folder/c_api_test" $times >"$folder/c.found"
  same_as_the_library "$folder/c.found"
  # Nothing but the interface is seen.
  nm -D --defined-only "$prefix/lib/libbookspin_dynamics.so" | grep -v ' bookspin_[a-z_]*$' && exit 1
  true
  ;;
python)
  command -v python3 >/dev/null || skip "there is no python3"
  python3 "$project/examples/exact.py" "$prefix/lib/libbookspin_dynamics.so"
  ;;
esac
