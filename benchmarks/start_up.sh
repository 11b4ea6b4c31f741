#!/bin/sh
# What the command line takes to start: least of ten runs each, user and system CPU [s]. CPU time,
# because the seconds of a clock depend on what else the machine does.
scenario=examples/maps/warehouse-10-20-10-2-1-random-1.scen
least() {
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        { /usr/bin/env time -f '%U %S' "$@" >/dev/null; } 2>&1 | tail -n 1 | awk '{ print $1 + $2 }'
    done | sort -n | head -n 1
}
printf 'import numpy                  %s\n' "$(least python -c 'import numpy')"
printf 'rightofway --version          %s\n' "$(least rightofway --version)"
printf 'rightofway --help             %s\n' "$(least rightofway --help)"
printf 'rightofway plan, 2 robots     %s\n' "$(least rightofway plan examples/door.yaml)"
printf 'rightofway plan, 400 robots   %s\n' \
    "$(least rightofway plan "$scenario" -k 400 --planner lacam -o /dev/null)"
