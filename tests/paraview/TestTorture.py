# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 900
# ctest-processors: 2
"""Whatever ParaView can throw at the plugin ends in a result or in one clear error, and the next good value works.

    ./cactus pvpython tests/paraview/TestTorture.py [--all] [--list] [--only PATTERN]... [--workers N] [--seconds N] [--report FILE]

Every source, filter, reader and writer of xml/ gets: every kind of data set in each of its inputs, every property at its limits, beyond
them and far out, odd file names, spoilt files, too little memory, a stop, data that change with time, and faults upstream. What
is asked of the answer stands in torture/answers.py. CTest runs the short list, about a twentieth of all; --all takes every case, and
--only those whose names match, for instance --only 'data/MyelinSurface/*'. Cases run in processes of their own, so that one that
crashes or hangs is known by name.

torture/known_failures.txt lists what is known to fail, with the reason: `PATTERN  # REASON`. A known failure that passes fails the test.
"""

import argparse
import fnmatch
import os
import sys
import time

from torture import pool

KNOWN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "torture", "known_failures.txt")


def known_failures():
    with open(KNOWN) as file:
        lines = [line.split("#", 1) for line in file if line.strip() and not line.startswith("#")]
    assert all(len(line) == 2 and line[1].strip() for line in lines), "each known failure needs its reason"
    return {line[0].strip(): line[1].strip() for line in lines}


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true", help="every case, not the short list")
    parser.add_argument("--list", action="store_true", help="only tell which cases there are")
    parser.add_argument("--only", action="append", default=[], metavar="PATTERN", help="cases whose names match")
    parser.add_argument("--workers", type=int, default=min(4, len(os.sched_getaffinity(0))))
    parser.add_argument("--seconds", type=float, default=20.0, help="that a case may take")
    parser.add_argument("--report", help="file to which every case is written as it ends")
    parser.add_argument("--worker", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--cold", help=argparse.SUPPRESS)
    parser.add_argument("--client", nargs=2, help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def chosen(cases, options):
    if options.only:
        return [name for name in cases if any(fnmatch.fnmatchcase(name, pattern) for pattern in options.only)]
    return [name for name, is_short in cases.items() if is_short or options.all]


def helper(script, options):
    """What the processes do that this test starts."""
    from torture import cases

    if options.cold:
        cases.cold(options.cold)
    elif options.client:
        cases.client(*options.client)
    else:
        pool.work(options.worker, lambda: cases.Bench(script))
    return 0


def main():
    options = parse(sys.argv[1:])
    script = os.path.abspath(__file__)
    if options.worker is not None or options.cold or options.client:
        return helper(script, options)
    lister = pool.Worker(script)
    answer = lister.ask("list", 60)
    if answer is None:
        sys.exit("no list of cases: " + lister.tail())
    cases = answer["cases"]
    lister.stop()
    names = chosen(cases, options)
    if options.list:
        print("\n".join(names))
        return 0
    begin = time.monotonic()
    file = open(options.report, "w") if options.report else None

    def report(name, faults, seconds, note):
        if file:
            file.write(f"{seconds:6.2f}  {name}  {faults if faults else 'ok'}  [{note}]\n")
            file.flush()

    results = pool.run(script, names, options.seconds, options.workers, report)
    return summary(results, cases, time.monotonic() - begin)


def summary(results, cases, seconds):
    """Prints what failed; 0 where all is as it should be."""
    known = known_failures()
    failed = {name: faults for name, (faults, _) in sorted(results.items()) if faults}
    excused = {name for name in failed if any(fnmatch.fnmatchcase(name, pattern) for pattern in known)}
    healed = [name for name in results if name not in failed and any(fnmatch.fnmatchcase(name, pattern) for pattern in known)]
    for name, faults in failed.items():
        if name not in excused:
            print(f"FAILED  {name}")
            for fault in faults:
                print("        " + fault.replace("\n", "\n        "))
    for name in healed:
        print(f"HEALED  {name}: take it out of known_failures.txt")
    slow = sorted(results, key=lambda name: -results[name][1])[:5]
    print("slowest: " + ", ".join(f"{name} {results[name][1]:.1f} s" for name in slow))
    bad = len(failed) - len(excused) + len(healed)
    print(f"{len(results)} of {len(cases)} cases in {seconds:.0f} s: {len(results) - len(failed)} as they should be, {len(excused)} known to fail, {bad} wrong")
    return 1 if bad or not results else 0


if __name__ == "__main__":
    sys.exit(main())
