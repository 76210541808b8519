# The front door. Each target works alone on a fresh Debian: it installs what is missing, builds, and runs.

.PHONY: figures test page report bench golden clean

# Every film, then the course page around them, in videos/site/.
figures: program
	build/bookspin render --update videos/*.toml -o videos/site
	build/bookspin page videos/site

test: everything
	@ctest --preset release; status=$$?; cat build/browser/skipped 2>/dev/null; exit $$status

# The course page alone, from the films that are there.
page: program
	build/bookspin page videos/site

# Speed against error, stability, the paper's claims measured: videos/site/report/, linked from the course page.
report: program
	build/bookspin report -o videos/site/report
	test ! -e videos/site/index.html || build/bookspin page videos/site

# What a frame costs, the rate of the whole job, peak memory; the exact solution against Boost.Math.
bench: everything
	build/stages_bench
	build/torque_free_bench

# Accept the frames that the tests draw as the new goldens. Then look at them, and commit them alone, with the reason.
golden: everything
	BOOKSPIN_ACCEPT_GOLDENS=1 ctest --preset release -R '^(image|render|film)$$'
	git status --short tests/golden

clean:
	rm -rf build build-debug build-sanitize videos/site

.PHONY: everything program configured packages
everything: configured
	cmake --build build
program: configured
	cmake --build build --target bookspin
configured: packages
	@cmake --preset release --log-level=WARNING >/dev/null
packages:
	@./install-packages
