#!/bin/sh
# How long the command line takes to start: best of ten runs each [s].
best() {
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        { /usr/bin/env time -f %e "$@" >/dev/null; } 2>&1 | tail -n 1
    done | sort -n | head -n 1
}
printf 'import numpy       %s\n' "$(best python -c 'import numpy')"
printf 'rightofway --help  %s\n' "$(best rightofway --help)"
printf 'rightofway plan    %s\n' "$(best rightofway plan examples/door.yaml)"
