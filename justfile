# Short recipes; CI runs the same ones. `just --list` shows them all.

scripts := "'src/**/assets/**/*.js' 'tests/js/**/*.js' '*.{js,json}'"

set shell := ["bash", "-euo", "pipefail", "-c"]

# Everything that can be checked without a new installation
default: lint types contracts test

# Style of Python, C++ and JavaScript; exports that nobody imports
lint: node-modules
    ruff check .
    ruff format --check .
    git ls-files 'cpp/*.cpp' 'cpp/*.hpp' | xargs clang-format --dry-run --Werror
    npx --no prettier -- --log-level warn --check {{ scripts }}
    git ls-files '*.js' | xargs npx --no eslint -- --no-warn-ignored --max-warnings 0
    npx --no knip -- --include files,exports,duplicates,unresolved --no-config-hints
    check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
    check-jsonschema --builtin-schema vendor.dependabot .github/dependabot.yml
    check-jsonschema --builtin-schema vendor.compose-spec deploy/compose.yaml
    zizmor --offline --quiet .github

# Bring everything into the house style
format: node-modules
    ruff check --fix .
    ruff format .
    npx --no prettier -- --log-level warn --write {{ scripts }}
    git ls-files 'cpp/*.cpp' 'cpp/*.hpp' | xargs clang-format -i

# Static types, strict, of Python and JavaScript
types: node-modules
    mypy
    npx --no tsc
    npx --no tsc -- -p tests/js

# The tools for JavaScript, those of package-lock.json; a network is needed only where they changed
node-modules:
    [ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --silent

# A wheel for this Python in build/wheels, its tag, and a try without a compiler on each of PYTHONS
wheel *pythons="python3":
    rm -rf build/wheels
    pip wheel -q --no-deps -w build/wheels .
    if [ "$(uname)" = Linux ]; then auditwheel repair -w build/wheels/repaired build/wheels/*.whl; fi
    .ci/try_wheel "$(ls build/wheels/repaired/*.whl build/wheels/*.whl 2>/dev/null | head -n 1)" {{ pythons }}

# The image of all commands, then broker, robots, control and studio as containers (deploy/compose.yaml)
containers engine="docker":
    rm -rf build/containers
    pip wheel -q -w build/containers '.[control,studio]'
    {{ engine }} build -f deploy/Containerfile -t rightofway \
        --build-arg PYTHON="$(python -c 'import sys; print("%d.%d" % sys.version_info[:2])')" .
    rightofway plan examples/floor.yaml -o deploy/site/plan.json
    RIGHTOFWAY_USER={{ if engine == "podman" { "0:0" } else { "$(id -u):$(id -g)" } }} \
        {{ engine }} compose -f deploy/compose.yaml up

# Write the versions that CI installs: the newest that fit together now
constraints:
    mkdir -p build
    pip install -q --dry-run --ignore-installed --report build/constraints.json \
        --group dev --group docs '.[test]'
    python -m tests.builders.constraints build/constraints.json

# Who may import whom
contracts:
    lint-imports

# The quick lane of the tests
test *args:
    pytest {{ args }}

# The thorough lane: browser, processes, every example of the documentation, laws with more time
thorough *args:
    pytest -m "(slow or law) and not nightly" --law-seconds 4 {{ args }}

# What CI leaves out, laws, fuzz and campaigns with fresh seeds, round after round until one fails
nightly law_seconds="60":
    just native-threads
    for ((round = 1; ; round++)); do \
        echo "round $round"; \
        pytest -m nightly; \
        pytest -m law --law-seconds {{ law_seconds }} --law-seed random; \
        just judge 20000; \
        just delay 200000; \
        just chaos 20000; \
        just kills 200; \
        just chaos-broker 100; \
        just chaos-broker 100 --jobs; \
        just fuzz-states 20000; \
        just fuzz-files 20000; \
        just fuzz-bindings --count 20000; \
    done

# Kill the studio in the middle of work COUNT times, and look for all that it had answered
kills count:
    python -m tests.campaigns.kills {{ count }}

# Judge plans of random fleets, good and broken ones, by both judges: a million take half an hour
judge count *args:
    python -m tests.campaigns.plans judge {{ count }} {{ args }}

# Compare plans of random fleets with all lower bounds that are proven of them: ten thousand take minutes
bounds count *args:
    python -m tests.campaigns.plans bound {{ count }} {{ args }}

# Make delayed runs of plans of random fleets: ten million take a quarter of an hour
delay count *args:
    python -m tests.campaigns.plans delay {{ count }} {{ args }}

# Drive plans of random fleets through chaos COUNT times: lost messages, kills, resets, wrong fields
chaos count *args:
    python -m tests.campaigns.plans chaos {{ count }} {{ args }}

# Drive plans with jobs that arrive through chaos, with the seeds from FIRST to before LAST, in each kind
chaos-jobs first last:
    python -m tests.campaigns.jobs {{ first }} {{ last }}

# Drive plans over a real broker COUNT times (0: without end), its processes killed at random; `--jobs`
chaos-broker count *args:
    python -m tests.campaigns.broker {{ count }} {{ args }}

# Have robots of vda-5050-lib make laps for MINUTES of robot time, ten times as fast; `--kills 20`
foreign-laps minutes *args:
    python -m tests.campaigns.foreign {{ minutes }} {{ args }}

# Send COUNT broken states to a control whose robots drive: a hundred thousand take some minutes
fuzz-states count *args:
    python -m tests.campaigns.states {{ count }} {{ args }}

# Break files of all formats that are read: a million take about an hour
fuzz-files count *args:
    python -m tests.builders.broken_files {{ count }} {{ args }}

# Broken calls of the native core at random, until stopped, or `--count 100000`: some minutes
fuzz-bindings *args:
    python -m tests.builders.broken_calls {{ args }}

# The same under AddressSanitizer and UndefinedBehaviorSanitizer: builds the module with them first
fuzz-bindings-sanitized *args:
    cmake -S . -B build/sanitized-core -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
        -DRIGHTOFWAY_BINDING=ON -DRIGHTOFWAY_SANITIZE=address,undefined -DPython_EXECUTABLE="$(which python)" \
        -Dnanobind_DIR="$(python -m nanobind --cmake_dir)"
    cmake --build build/sanitized-core --parallel "$(nproc)"
    CORE="$(echo build/sanitized-core/_core*.so)" ASAN_OPTIONS=detect_leaks=0 \
        LD_PRELOAD="$(${CXX:-c++} -print-file-name=libasan.so) $(${CXX:-c++} -print-file-name=libstdc++.so)" \
        python -m tests.builders.broken_calls {{ args }}

# The native tests under AddressSanitizer and UndefinedBehaviorSanitizer, warnings as errors
native:
    cmake --preset sanitize
    cmake --build --preset sanitize --parallel "$(nproc)"
    ctest --preset sanitize

# The native tests that run threads, under ThreadSanitizer
native-threads:
    cmake --preset thread
    cmake --build --preset thread --parallel "$(nproc)"
    build/thread/rightofway_tests -tc='*thread*,*task*,*crew*,*stuck*,*population*,*turn*,*caller*'

# Write the stub of the native core from the installed module
stub:
    python -m nanobind.stubgen -m rightofway._core -o src/rightofway/_core.pyi

# Fail if the committed stub is not that of the installed module
stub-is-fresh:
    python -m nanobind.stubgen -m rightofway._core -o build/_core.pyi
    diff -u src/rightofway/_core.pyi build/_core.pyi

# The documentation, warnings as errors, into docs/_build/html
docs:
    sphinx-build -W --keep-going -q -b html docs docs/_build/html

# The documentation with the pages of the gallery, each made by its command (a minute or two)
gallery *args:
    sphinx-build -W --keep-going -q -t gallery -b html docs docs/_build/html
    python -m tests.builders.gallery docs/_build/html/gallery {{ args }}

# Write the generated parts of the pages: help texts, tables of keys, options and names
docs-refresh:
    python docs/refresh.py

# Write the scripts of others that the studio ships, from the packages of npm that package.json pins
vendor: node-modules
    python -m tests.builders.vendored

# Write the types that JavaScript shares with Python
types-refresh:
    python -m tests.builders.typescript

# Install for work on the code: edits to Python files are live, `just develop` again after C++
develop:
    pip install 'pip>=25.1' scikit-build-core nanobind
    pip install --group dev --group docs
    pip install --no-build-isolation -e '.[test]'

# Run a suite of benchmarks/suites, or go on with it: rows in build/NAME.csv, report in build/NAME.html
suite name *args:
    mkdir -p build
    rightofway bench benchmarks/suites/{{ name }}.toml -o build/{{ name }}.csv --report build/{{ name }}.html {{ args }}

# Measure: kernels, start-up (see benchmarks/README.md)
bench:
    pytest -n 0 benchmarks/bench_kernels.py --benchmark-columns=median,iqr,rounds --benchmark-sort=name
    benchmarks/start_up.sh

# How far planners are from the best right of way on their routes: tables and plot of docs/results/improvement.md
gaps:
    python -m benchmarks.gaps

# Two-level beside priorities: tables and plots of docs/results/priorities.md (an hour)
priorities: (suite "priorities") (suite "priorities_aisles")
    python -m benchmarks.pages priorities build/priorities.csv build/priorities_aisles.csv

# CPU share and answers of a control with 200 robots at a broker (benchmarks/README.md)
control-at-a-broker *args:
    python -m benchmarks.control_at_a_broker {{ args }}

# How soon random fleets repeat themselves: tables and plots of docs/results/second-lap.md (minutes)
laps: (suite "cyclic")
    python -m benchmarks.pages laps build/cyclic.csv

# How much a chosen timetable gains over rules: a table of docs/results/second-lap.md (minutes)
timetables: (suite "timetables")
    python -m benchmarks.pages timetables build/timetables.csv

# Plans of every planner on late floors: the tables of docs/results/late-floors.md, the plot of docs/execution.md
late-floors *args:
    python -m benchmarks.late_floors {{ args }}
