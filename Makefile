# The front door. Each target works alone on a fresh Debian or Ubuntu: it installs what is missing, builds, and runs.

.PHONY: figures page test golden report bench clean build packages

figures: build
	build/bookspin render --update videos/*.toml -o videos/site
	build/bookspin page videos/site

# The course page alone, from the films that are there.
page: build
	build/bookspin page videos/site

test: everything
	@ctest --preset release; status=$$?; cat build/browser/skipped 2>/dev/null; exit $$status

# Accept the frames that the tests draw as the new goldens. Then look at them, and commit them alone, with the reason.
golden: everything
	BOOKSPIN_ACCEPT_GOLDENS=1 ctest --preset release -R '^(image|render|film)$$'
	git status --short tests/golden

# Speed against error, stability, the paper's claims measured: videos/site/report/index.html.
report: build
	build/bookspin report

# What a frame costs, the rate of the whole job, peak memory.
bench: everything
	build/stages_bench

clean:
	rm -rf build build-debug build-sanitize videos/site

.PHONY: everything configure
everything: configure
	cmake --build build
build: configure
	cmake --build build --target bookspin
configure: packages
	@cmake --preset release --log-level=WARNING
packages:
	@./install-packages
