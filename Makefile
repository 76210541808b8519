# The front door. Each target works alone on a fresh Debian: it installs what is missing, builds, and runs.

.NOTPARALLEL:  # two builds in one folder break it; each build uses every core by itself
.PHONY: figures gallery test page report bench golden package matrix sanitize sanitize-readers coverage tidy clean

# Every film, the course page around them, and where there is no report one made in seconds, to which the page links: videos/site/.
figures: program
	build/bookspin render --update videos/*.toml -o videos/site
	build/bookspin page videos/site
	test -e videos/site/report/index.html || { build/bookspin report --quick -o videos/site/report && build/bookspin page videos/site; }

# Bodies from elsewhere, each held against a published or closed-form value, and their page: videos/site/more/.
gallery: program
	build/bookspin render --update videos/more/*.toml -o videos/site/more
	build/bookspin page videos/site/more

test: everything
	@tests/page/browser_tools.sh build/browser
	@ctest --test-dir build --output-on-failure; status=$$?; cat build/browser/skipped 2>/dev/null; exit $$status

# The course page alone, from the films that are there.
page: program
	build/bookspin page videos/site

# Speed against error, stability, the paper's claims measured: videos/site/report/, linked from the course page.
report: program
	build/bookspin report -o videos/site/report
	test ! -e videos/site/index.html || build/bookspin page videos/site

# What a frame costs, the rate of the whole job, peak memory; the exact solution against Boost.Math.
bench: everything
	build/stages_bench videos/fig05_unstable_x.toml build/bench.json
	build/torque_free_bench

# Accept the frames that the tests draw as the new goldens. Then look at them, and commit them alone, with the reason.
golden: everything
	BOOKSPIN_ACCEPT_GOLDENS=1 ctest --test-dir build --output-on-failure -R '^(image|render|film)$$'
	git status --short tests/golden

# Debian packages, in build/: the program with its files, and the library bookspin::dynamics.
package: configured
	cmake --build build --target bookspin bookspin_printed bookspin_c bookspin_single_header
	@printf 'dpkg-dev\nfile\n' >build/package-tools && ./install-packages build/package-tools
	cd build && cpack

# Both commands in fresh roots of other releases of Debian and Ubuntu, for maintainers: docs/SYSTEMS.md.
matrix:
	tools/matrix $(SUITES)

# The tests, but for those in browsers, under sanitizers for addresses and undefined behavior.
sanitize: packages
	cmake --preset sanitize --log-level=WARNING >/dev/null
	cmake --build build-sanitize
	ctest --preset sanitize -E page_browser

# Of these, what reads files that others wrote: checked with every submission.
sanitize-readers: packages
	cmake --preset sanitize --log-level=WARNING >/dev/null
	cmake --build build-sanitize --target files_tests image_tests fuzz_script fuzz_data fuzz_png
	ctest --preset sanitize -R '^(files|image|fuzz_.*)$$'

# How much of the physics and of the scenes their own tests run: at least 95 % of the lines.
coverage: packages
	cmake -S . -B build-coverage -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='--coverage -O1' --log-level=WARNING >/dev/null
	@echo gcovr >build-coverage/tools && ./install-packages build-coverage/tools
	cmake --build build-coverage --target dynamics_tests scene_tests
	ctest --test-dir build-coverage --output-on-failure -R '^(dynamics|scene)$$'
	gcovr --filter src/dynamics/ --filter src/scene/ --fail-under-line 95 build-coverage

# What clang-tidy finds in src, read a room at a time, as make compiles it.
tidy: program
	@echo clang-tidy >build/tidy-tools && ./install-packages build/tidy-tools
	sed -n 's|.*"file": "\($(CURDIR)/\(build/\)*src/.*\)".*|\1|p' build/compile_commands.json | \
	  xargs -d '\n' -P $$(nproc) -n 1 clang-tidy -p build --quiet --checks=-bugprone-suspicious-include \
	  --extra-arg=-Wno-unknown-warning-option --header-filter='$(CURDIR)/src/.*\.(h|cpp)$$'

clean:
	rm -rf build build-coverage build-debug build-sanitize videos/site

.PHONY: everything program configured packages
everything: configured
	cmake --build build
program: configured
	cmake --build build --target bookspin
configured: packages  # not by the preset: a cmake that is too old would not find it, instead of saying that it is too old
	@cmake -S . -B build -G Ninja -DCMAKE_UNITY_BUILD=ON --log-level=WARNING >/dev/null
packages:
	@./install-packages
