# qipov: POV-Ray scenes with bicubic patches, rendered natively with the quasi-interpolating net.
#   make         build the four programs into build/
#   make demo    install what is missing, render the teapot with QI and with POV-Ray, compare
#   make test    install what is missing, build, run all tests (AddressSanitizer, UBSan)
#   make test-examples  read every scene that POV-Ray's distribution has, as POV-Ray does
#   make install  to PREFIX (/usr/local), below DESTDIR
#   make report   what accuracy costs: curves, tables and maps as a page (5 minutes); make study, accuracy
#   make gallery the pictures of README; make bench its table of speed; make deps lint clean
MAKEFLAGS += --no-builtin-rules
.DELETE_ON_ERROR:
.SECONDARY:

PACKAGES = gcc g++ pkg-config povray povray-includes povray-examples libopenimageio-dev \
           openimageio-tools libpng-dev libfreetype-dev libcmocka-dev libjansson-dev
REPORT_PACKAGES = gnuplot-nox
BROWSER_PACKAGES = chromium
LINT_PACKAGES = clang-format clang-tidy cppcheck

CC  ?= gcc
CXX ?= g++
ifeq ($(origin CC),default)
CC = gcc
endif
ifeq ($(origin CXX),default)
CXX = g++
endif
WARN   = -Wall -Wextra -Wshadow -Werror
CWARN  = $(WARN) -Wconversion -Wmissing-prototypes -Wstrict-prototypes
FREETYPE := $(patsubst -I%,-isystem%,$(shell pkg-config --cflags-only-I freetype2 2>/dev/null))
# gcc 12 takes (double)(float)x for x where it joins two of them into a vector.
BASE   = -Isrc -I. $(FREETYPE) -ffp-contract=off -fno-tree-slp-vectorize -fopenmp -MMD -MP -D_GNU_SOURCE
# gcc copies points 16 bytes at a time that were written 8 bytes at a time just before, and such
# reads wait for the writes: a tenth of what a ray costs.
COPY     = -mtune-ctrl=^sse_unaligned_load_optimal,^sse_unaligned_store_optimal
CFLAGS   ?= -O3 -g -DNDEBUG $(shell $(CC) $(COPY) -E -x c /dev/null >/dev/null 2>&1 && echo '$(COPY)')
SAN      = -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined -DHOSTILE
C11    = -std=c11 $(CWARN) $(BASE)
CXX17  = -std=c++17 $(WARN) $(BASE)
LIBS   = -lpng -ljansson -lfreetype -lm
# OpenImageIO is loaded when it is needed (src/image/oiio.h).
IMAGE_LIBS = -lOpenImageIO -lOpenImageIO_Util

# The kernel is compiled once per instruction set; nothing else has an -m flag.
KERNEL      = src/kernel/kernel.c
ISAS        = scalar $(if $(findstring x86_64,$(shell $(CC) -dumpmachine)),avx2 avx512)
ISA_avx2    = -mavx2 -mbmi -mbmi2 -mlzcnt -mpopcnt
ISA_avx512  = $(ISA_avx2) -mavx512f -mavx512vl -mavx512bw -mavx512dq
KERNEL_OBJ  = $(ISAS:%=build/src/kernel/kernel_%.o)
KERNEL_TEST = $(ISAS:%=build/test/src/kernel/kernel_%.o)

MAINS    = converter/main.c $(wildcard src/cmd/*.c)
LIB_C    = $(filter-out $(MAINS) $(KERNEL),$(wildcard converter/*.c src/*/*.c))
LIB_CXX  = src/image/image_oiio.cpp
PROGRAMS = pov2qi $(patsubst src/cmd/%.c,%,$(wildcard src/cmd/*.c))
TESTS    = $(patsubst tests/%.c,%,$(wildcard tests/test_*.c))
TEST_LIB = $(filter-out $(wildcard tests/test_*.c),$(wildcard tests/*.c))

OBJ      = $(LIB_C:%.c=build/%.o) $(KERNEL_OBJ)
TEST_OBJ = $(LIB_C:%.c=build/test/%.o) $(KERNEL_TEST)
IMAGE_LIB = libqipov_image.so
SHARED   = build/test/libtests.a

all: $(PROGRAMS:%=build/%) build/$(IMAGE_LIB) build/libqipatch.a

$(KERNEL_OBJ): build/src/kernel/kernel_%.o: $(KERNEL)
	@mkdir -p $(@D)
	@echo '  CC  $< ($*)'
	@$(CC) $(C11) $(CFLAGS) $(ISA_$*) -Wno-psabi -DKERNEL_ISA=$* -c -o $@ $<
$(KERNEL_TEST): build/test/src/kernel/kernel_%.o: $(KERNEL)
	@mkdir -p $(@D)
	@echo '  CC  $< ($*, sanitized)'
	@$(CC) $(C11) $(SAN) $(ISA_$*) -Wno-psabi -DKERNEL_ISA=$* -c -o $@ $<
build/%.o: %.c
	@mkdir -p $(@D)
	@echo '  CC  $<'
	@$(CC) $(C11) $(CFLAGS) -c -o $@ $<
build/%.o: %.cpp
	@mkdir -p $(@D)
	@echo '  CXX $<'
	@$(CXX) $(CXX17) $(CFLAGS) -fPIC -c -o $@ $<
build/test/%.o: %.c
	@mkdir -p $(@D)
	@echo '  CC  $< (sanitized)'
	@$(CC) $(C11) $(SAN) -c -o $@ $<
build/test/%.o: %.cpp
	@mkdir -p $(@D)
	@echo '  CXX $< (sanitized)'
	@$(CXX) $(CXX17) $(SAN) -fPIC -c -o $@ $<

build/$(IMAGE_LIB): $(LIB_CXX:%.cpp=build/%.o)
	@echo '  LD  $@'
	@$(CXX) -shared -o $@ $^ $(IMAGE_LIBS)
build/test/$(IMAGE_LIB): $(LIB_CXX:%.cpp=build/test/%.o)
	@echo '  LD  $@'
	@$(CXX) -shared -fsanitize=address,undefined -o $@ $^ $(IMAGE_LIBS)
build/pov2qi: build/converter/main.o $(OBJ)
	@echo '  LD  $@'
	@$(CC) -fopenmp -o $@ $^ $(LIBS)
build/qi%: build/src/cmd/qi%.o $(OBJ)
	@echo '  LD  $@'
	@$(CC) -fopenmp -o $@ $^ $(LIBS)

# One object of all that the library needs, in which only the public names are visible.
build/libqipatch.a: $(filter build/src/patch/% build/src/kernel/% build/src/base/%,$(OBJ))
	@echo '  AR  $@'
	@ld -r -o build/qipatch.o $^
	@objcopy -w --keep-global-symbol='qipatch_*' build/qipatch.o
	@rm -f $@
	@ar rcs $@ build/qipatch.o

# Rays at all extremes against an exact oracle.
STRESS_OBJ = $(patsubst %.c,build/%.o,$(wildcard tests/programs/stress.c tests/stress*.c tests/ray_oracle*.c))
build/stress: $(STRESS_OBJ) $(filter build/src/base/% build/src/patch/% build/src/kernel/%,$(OBJ))
	@echo '  LD  $@'
	@$(CC) -fopenmp -o $@ $^ -lm -ldl

# The sweep over all primitives, with the programs' own objects.
SOLIDS_OBJ = $(patsubst %,build/tests/%.o,test_solids_povray convert_help povray_pictures)
build/solids: $(SOLIDS_OBJ) $(OBJ)
	@echo '  LD  $@'
	@$(CC) -fopenmp -o $@ $^ -lcmocka $(LIBS)

# Random trees of solids and patches against POV-Ray and an oracle.
CSG_OBJ = $(patsubst %.c,build/%.o,$(wildcard tests/programs/csg_trees.c tests/csg_*.c tests/povray_pictures.c))
build/csg_trees: $(CSG_OBJ) $(filter build/src/base/%,$(OBJ))
	@echo '  LD  $@'
	@$(CC) -fopenmp -o $@ $^ -lm

# The programs under the sanitizers, for tests that run them; and the cmocka programs.
build/test/pov2qi: build/test/converter/main.o $(TEST_OBJ) | build/test/$(IMAGE_LIB)
	@echo '  LD  $@'
	@$(CC) -fopenmp -fsanitize=address,undefined -o $@ $^ $(LIBS)
build/test/qi%: build/test/src/cmd/qi%.o $(TEST_OBJ) | build/test/$(IMAGE_LIB)
	@echo '  LD  $@'
	@$(CC) -fopenmp -fsanitize=address,undefined -o $@ $^ $(LIBS)
build/test/test_%: build/test/tests/test_%.o $(TEST_OBJ) $(SHARED) | build/test/$(IMAGE_LIB)
	@echo '  LD  $@'
	@$(CC) -fopenmp -fsanitize=address,undefined -o $@ $^ -lcmocka $(LIBS)
$(SHARED): $(TEST_LIB:%.c=build/test/%.o)
	@rm -f $@
	@ar rcs $@ $^

deps:
	@tests/deps.sh $(PACKAGES)

test: deps
	@tests/deps.sh $(REPORT_PACKAGES) $(BROWSER_PACKAGES)
	@$(MAKE) --no-print-directory -j$$(nproc) all build/test/$(IMAGE_LIB) $(PROGRAMS:%=build/test/%) $(TESTS:%=build/test/%)
	@tests/run.sh $(TESTS)

# The language tested in itself, by pov2qi and by POV-Ray.
test-povray: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/test/test_language
	@tests/run.sh test_language

# The fuzzers, by clang; what of the library they need. tests/fuzz.sh says what they do.
FUZZ_OBJ = $(patsubst %.c,build/fuzz/%.o,$(filter-out src/render/render.c src/bench/%,$(LIB_C))) \
           $(KERNEL_TEST:build/test/%=build/fuzz/%)
FUZZ     = -std=c11 $(filter-out -fopenmp,$(BASE)) -w -O2 -g -fsanitize=fuzzer-no-link,address,undefined \
           -fsanitize=float-cast-overflow -fno-sanitize-recover=undefined,float-cast-overflow -DHOSTILE
build/fuzz/src/kernel/kernel_%.o: $(KERNEL)
	@mkdir -p $(@D)
	@clang $(FUZZ) $(ISA_$*) -Wno-psabi -DKERNEL_ISA=$* -c -o $@ $<
build/fuzz/%.o: %.c
	@mkdir -p $(@D)
	@echo '  CC  $< (fuzz)'
	@clang $(FUZZ) -c -o $@ $<
build/fuzz/lib.a: $(FUZZ_OBJ)
	@rm -f $@
	@ar rcs $@ $^
build/fuzz/fuzz_%: build/fuzz/tests/fuzz/fuzz_%.o build/fuzz/lib.a
	@echo '  LD  $@'
	@clang -fsanitize=fuzzer,address,undefined -o $@ $^ $(LIBS) -ldl

fuzz: deps
	@tests/deps.sh clang libclang-rt-14-dev
	@$(MAKE) --no-print-directory -j$$(nproc) build/fuzz/fuzz_scene build/fuzz/fuzz_json build/pov2qi
	@tests/fuzz.sh scene 3000
	@tests/fuzz.sh json 600

# Every primitive in every variant against POV-Ray, as a table (about four minutes).
solids: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/solids
	@QIPOV_SOLIDS=full build/solids

# 1,000 random trees, and 1,000 with bounds: the table in tests/csg_trees.txt (two minutes).
csg-trees: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/qirender build/csg_trees
	@{ build/csg_trees 1 1000 && build/csg_trees 1 1000 bounds; } >tests/csg_trees.txt; \
	    status=$$?; cat tests/csg_trees.txt; exit $$status

# Real scenes of solids against POV-Ray: pictures and times, into the table.
solids-pictures: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/solids_pictures.sh >tests/solids_pictures.txt; status=$$?; cat tests/solids_pictures.txt; exit $$status

# How work grows with the number of solids and of copies; README's table (two minutes).
scaling: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/scaling.sh

lint:
	@tests/deps.sh $(LINT_PACKAGES)
	@tests/lint.sh

demo: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/demo.sh

bench-parse: deps
	@$(MAKE) --no-print-directory build/pov2qi
	@tests/bench_parse.sh

expressions: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/test/test_expressions
	@QIPOV_EXPRESSIONS=20000 ASAN_OPTIONS=detect_leaks=0 build/test/test_expressions

clean:
	rm -rf build

# Pictures against POV-Ray's, with a table: all textures of the standard includes; the texture scenes
# of povray-examples, and how long both take. 470,000 random points through random patterns. Minutes each.
sheet: all
	@tests/texture_sheet.sh
examples-pictures: all
	@tests/examples_pictures.sh
pages: all
	@mkdir -p build/pages
	@PAGES=build/pages tests/examples_pictures.sh patches
examples-speed: all
	@tests/examples_speed.sh | tee tests/examples_speed.txt
points: build/test/test_points
	@POINTS_ROUNDS=34 build/test/test_points

# All scenes of povray-examples and all standard includes, against POV-Ray: minutes.
test-examples: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/pov2qi
	@tests/examples.sh

# Thousands of small wrong programs: is the same refused as by POV-Ray? MUTATIONS="FIRST COUNT".
MUTATIONS ?= 1 3000
build/mutate: build/tests/programs/mutate.o
	@echo '  LD  $@'
	@$(CC) -o $@ $^
test-mutations: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/pov2qi build/mutate
	@tests/mutations.sh --grammar
	@tests/mutations.sh $(MUTATIONS)

# PREFIX is where it will run, DESTDIR where it is put for now (packages).
PREFIX ?= /usr/local
INTO = $(DESTDIR)$(PREFIX)
VERSION = $(shell sed -n 's/.*QIPOV_VERSION "\(.*\)"/\1/p' src/base/version.h)
install: all
	install -d $(INTO)/bin $(INTO)/lib/pkgconfig $(INTO)/include $(INTO)/share/man/man1 $(INTO)/share/bash-completion/completions
	install -m 755 $(PROGRAMS:%=build/%) $(INTO)/bin
	install -m 644 build/$(IMAGE_LIB) build/libqipatch.a $(INTO)/lib
	install -m 644 src/patch/qipatch.h $(INTO)/include
	sed 's|@PREFIX@|$(PREFIX)|; s|@VERSION@|$(VERSION)|' src/patch/qipatch.pc.in >$(INTO)/lib/pkgconfig/qipatch.pc
	for p in $(PROGRAMS); do build/$$p --man >$(INTO)/share/man/man1/$$p.1; \
	    build/$$p --completion >$(INTO)/share/bash-completion/completions/$$p; done

gallery: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/gallery.sh

BENCH_ROUNDS ?= 5
bench: deps
	@tests/deps.sh libembree-dev
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/bench.sh $(BENCH_ROUNDS)

# The trade of speed against accuracy: a page in build/report, and whether errors fall with tolerances.
# The scenes that are there are measured. study: README's section on how wrong POV-Ray is. accuracy:
# is `pixel` `exact` to the eye, on all scenes in reach?
REPORT_SCENES = /usr/share/doc/povray/examples/advanced/teapot/teapot.pov scenes/dunes/dunes.pov \
    $(wildcard ../shared/corpus/postit/postit.pov ../shared/corpus/fmunoz/fruit_only.pov)
REPORT_ROUNDS ?= 3
REPORT_SIZE ?= 200x150
REPORT_PATIENCE ?= 3
report: deps
	@tests/deps.sh $(REPORT_PACKAGES)
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@mkdir -p build
	@build/qibench sweep --rounds $(REPORT_ROUNDS) --size $(REPORT_SIZE) --patience $(REPORT_PATIENCE) \
	    --html build/report $(REPORT_SCENES)
	@tests/sweep_check.sh build/report/sweep.csv && echo build/report/index.html
STUDY_ROUNDS ?= 1
STUDY_PATIENCE ?= 20
study: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/study.sh $(STUDY_ROUNDS) $(STUDY_PATIENCE)
accuracy: deps
	@$(MAKE) --no-print-directory -j$$(nproc) all
	@tests/accuracy.sh

# Rays at all extremes, judged by an exact oracle; STRESS="--rays 1e6 --case cusp" for less.
stress: deps
	@$(MAKE) --no-print-directory -j$$(nproc) build/stress
	@tests/stress.sh $(STRESS)

.PHONY: accuracy
.PHONY: all
.PHONY: bench
.PHONY: bench-parse
.PHONY: clean
.PHONY: csg-trees
.PHONY: demo
.PHONY: deps
.PHONY: examples-pictures
.PHONY: examples-speed
.PHONY: expressions
.PHONY: fuzz
.PHONY: gallery
.PHONY: install
.PHONY: lint
.PHONY: pages
.PHONY: points
.PHONY: report
.PHONY: scaling
.PHONY: sheet
.PHONY: solids
.PHONY: solids-pictures
.PHONY: stress
.PHONY: study
.PHONY: test
.PHONY: test-examples
.PHONY: test-mutations
.PHONY: test-povray
-include $(shell find build -name '*.d' 2>/dev/null)
